// The numbers that a map is judged by, one per triangle, and the ranges in which they are shown.

// The total areas of surface and layout, both as they are scaled for the page; and the mean over the surface of the logarithm of the ratio of
// lengths, in the layout to those on the surface.
export function total_areas(data)
{
  const { points: p, layout: q, triangles: t } = data;
  const area_of = (p, a, b, c) => {
    const x = p[b] - p[a], y = p[b + 1] - p[a + 1], z = p[b + 2] - p[a + 2], r = p[c] - p[a], s = p[c + 1] - p[a + 1], w = p[c + 2] - p[a + 2];
    return Math.hypot(y * w - z * s, z * r - x * w, x * s - y * r) / 2;
  };
  let surface = 0, layout = 0, weight = 0, sum = 0;
  for(let i = 0; i < t.length; i += 3)
  {
    const a = 3 * t[i], b = 3 * t[i + 1], c = 3 * t[i + 2], d = 2 * t[i], e = 2 * t[i + 1], f = 2 * t[i + 2];
    const area = area_of(p, a, b, c);
    const image = data.is_sphere ? area_of(q, a, b, c) : Math.abs((q[e] - q[d]) * (q[f + 1] - q[d + 1]) - (q[e + 1] - q[d + 1]) * (q[f] - q[d])) / 2;
    if(Number.isFinite(area) && Number.isFinite(image))
    {
      surface += area;
      layout += image;
      if(area > 0 && image > 0)
      {
        weight += area;
        sum += area * Math.log(image / area) / 2;
      }
    }
  }
  return { surface: surface || 1, layout: layout || 1, log_length_ratio: weight > 0 ? sum / weight : 0 };
}

// The logarithm that a 16-bit code stands for; see Coded_logarithms in page_data.h.
function decoded(code, range)
{
  return code === 0 ? NaN : code === 65535 ? Infinity : range[0] + (code - 1) / 65533 * (range[1] - range[0]);
}

export function number_text(x)
{
  if(x === null || Number.isNaN(x))
    return "none";
  if(! Number.isFinite(x))
    return x > 0 ? "infinite" : "-infinite";
  const size = Math.abs(x);
  return (size !== 0 && (size < 1e-3 || size >= 1e6) ? x.toExponential(2) : String(Number(x.toPrecision(4)))).replace("-", "\u2212");
}

// In the order of the buttons. `of` makes the value of a face, `text` writes it, `low` and `high` are the shares of triangles that are below and above
// the range that is coloured: few triangles, of the worst shape, would otherwise take all colours for themselves.
export function make_quantities(data)
{
  const areas = total_areas(data), log_ratio = Math.log(areas.layout / areas.surface);
  const { triangles: t, u } = data;
  return {
    areas,
    log_ratio,
    "u": {
      name: "u", label: "logarithmic scale factor u", low: .005, high: .005, least_width: 1e-9, text: number_text,
      of: f => (u[t[3 * f]] + u[t[3 * f + 1]] + u[t[3 * f + 2]]) / 3
    },
    "area": {
      name: "Area", label: "area factor, over its mean", low: .005, high: .005, least_width: .02, text: x => "\u00d7 " + number_text(2 ** x),
      of: f => (decoded(data.area_codes[f], data.areaRange) - log_ratio) / Math.LN2
    },
    "quasi-conformal": {
      name: "Quasi-conformal", label: "quasi-conformal factor", low: 0, high: .01, least_width: .01, lower: 1, text: number_text,
      of: f => Math.exp(decoded(data.factor_codes[f], data.factorRange))
    }
  };
}

// The values of all faces, and the range of nearly all. Ranges are found from a sample if there are very many.
export function evaluate(quantity, number_of_faces)
{
  if(quantity.values)
    return quantity;
  const values = quantity.values = new Float32Array(number_of_faces);
  for(let f = 0; f < number_of_faces; ++f)
    values[f] = quantity.of(f);
  const step = Math.ceil(number_of_faces / 200000), sample = [];
  for(let f = 0; f < number_of_faces; f += step)
    if(Number.isFinite(values[f]))
      sample.push(values[f]);
  const sorted = Float32Array.from(sample).sort(), last = sorted.length - 1;
  let low = last < 0 ? 0 : sorted[Math.floor(quantity.low * last)], high = last < 0 ? 1 : sorted[Math.ceil((1 - quantity.high) * last)];
  if(quantity.lower !== undefined)
    low = quantity.lower;
  if(high - low < quantity.least_width)
    [low, high] = quantity.lower !== undefined ? [low, low + quantity.least_width]
                                              : [(low + high - quantity.least_width) / 2, (low + high + quantity.least_width) / 2];
  quantity.range = [low, high];
  return quantity;
}

// How many triangles are in each of `n` even parts of the range; how many are below, above, and without a number.
export function histogram_of(quantity, n)
{
  const [low, high] = quantity.range, counts = new Uint32Array(n);
  let below = 0, above = 0, none = 0;
  for(const x of quantity.values)
    if(Number.isNaN(x))
      ++none;
    else if(x < low)
      ++below;
    else if(x > high)
      ++above;
    else
      ++counts[Math.min(n - 1, Math.floor((x - low) / (high - low) * n))];
  return { counts, below, above, none };
}
