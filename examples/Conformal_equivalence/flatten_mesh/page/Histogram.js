// The legend: how many triangles have which value, in the colours of the pictures. What is under the cursor is what the pictures keep.

import { histogram_of, number_text } from "./quantities.js";

const number_of_bars = 64, end_width = 9; // the bars at both ends are for what is out of range

export class Histogram
{
  // on_band(null or [low, high])
  constructor(canvas, output, palette, on_band)
  {
    Object.assign(this, { canvas, output, palette, on_band, band: null, tick: null });
    canvas.addEventListener("pointermove", e => this.choose(this.bar_at(e.offsetX)));
    canvas.addEventListener("pointerdown", e => this.choose(this.bar_at(e.offsetX)));
    canvas.addEventListener("pointerleave", () => this.choose(null));
    canvas.addEventListener("blur", () => this.choose(null));
    canvas.addEventListener("keydown", e => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
      if(step)
      {
        this.choose(this.bar === null ? (step > 0 ? 0 : number_of_bars - 1) : Math.max(-1, Math.min(number_of_bars, this.bar + step)));
        e.preventDefault();
      }
    });
    this.bar = null;
  }

  show(quantity)
  {
    this.quantity = quantity;
    this.counts = histogram_of(quantity, number_of_bars);
    this.bar = null;
    this.canvas.setAttribute("aria-label", `Histogram of the ${quantity.label}. Left and right choose a range.`);
    this.write();
    this.draw();
  }

  // -1 and number_of_bars are the ends.
  bar_at(x)
  {
    const w = this.canvas.clientWidth;
    if(x < end_width)
      return -1;
    return x >= w - end_width ? number_of_bars : Math.min(number_of_bars - 1, Math.floor((x - end_width) / (w - 2 * end_width) * number_of_bars));
  }

  // The values of a bar, from and to.
  bounds(bar)
  {
    const [low, high] = this.quantity.range, at = i => low + (high - low) * i / number_of_bars;
    return bar < 0 ? [-3e38, low] : bar >= number_of_bars ? [high, 3e38] : [at(bar), at(bar + 1)];
  }

  choose(bar)
  {
    if(! this.quantity || bar === this.bar)
      return;
    this.bar = bar;
    this.on_band(bar === null ? null : this.bounds(bar));
    this.write();
    this.draw();
  }

  // A value is marked by a tick.
  set_tick(value)
  {
    if(this.tick !== value && this.quantity)
    {
      this.tick = value;
      this.draw();
    }
  }

  write()
  {
    const { text, label, range } = this.quantity, { counts, below, above, none } = this.counts;
    if(this.bar === null)
    {
      const outside = [below && `${below} below`, above && `${above} above`, none && `${none} without`].filter(Boolean).join(", ");
      this.output.textContent = `${label}: ${text(range[0])} \u2026 ${text(range[1])}${outside ? "; " + outside : ""}`;
      return;
    }
    const [low, high] = this.bounds(this.bar), n = this.bar < 0 ? below : this.bar >= number_of_bars ? above : counts[this.bar];
    const where = this.bar < 0 ? `below ${text(high)}` : this.bar >= number_of_bars ? `above ${text(low)}` : `${text(low)} \u2026 ${text(high)}`;
    this.output.textContent = `${where}: ${n} ${n === 1 ? "triangle" : "triangles"}`;
  }

  draw()
  {
    const { canvas, quantity } = this, ratio = devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    if(! quantity || ! w)
      return;
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
    const g = canvas.getContext("2d"), { counts, below, above } = this.counts;
    g.scale(ratio, ratio);
    const scale_height = 6, room = h - scale_height - 2, step = (w - 2 * end_width) / number_of_bars;
    // square roots, so that rare values are seen beside frequent ones
    const most = Math.sqrt(Math.max(below, above, ...counts)) || 1;
    const bar = (x, width, n, color, i) => {
      g.globalAlpha = this.bar === null || this.bar === i ? 1 : .3;
      g.fillStyle = color;
      g.fillRect(x, h - scale_height, width, scale_height);
      const height = n ? Math.max(1.5, Math.sqrt(n) / most * room) : 0;
      g.fillRect(x, room - height, width, height);
    };
    for(let i = 0; i < number_of_bars; ++i)
      bar(end_width + i * step, step + .3, counts[i], this.palette.at((i + .5) / number_of_bars), i);
    if(below)
      bar(0, end_width - 3, below, this.palette.under, -1);
    if(above)
      bar(w - end_width + 3, end_width - 3, above, this.palette.over, number_of_bars);
    g.globalAlpha = 1;
    if(this.tick !== null && ! Number.isNaN(this.tick))
    {
      const t = (this.tick - quantity.range[0]) / (quantity.range[1] - quantity.range[0]);
      const x = t < 0 ? end_width / 2 : t > 1 ? w - end_width / 2 : end_width + t * (w - 2 * end_width);
      g.fillStyle = this.palette.ink;
      g.fillRect(x - .75, 0, 1.5, h);
    }
  }
}
