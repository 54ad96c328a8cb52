// The marks over a picture, as SVG: so a mark that follows the cursor costs no drawing of triangles.

const svg_namespace = "http://www.w3.org/2000/svg";

function svg_element(parent, name, attributes)
{
  const element = document.createElementNS(svg_namespace, name);
  for(const key in attributes)
    element.setAttribute(key, attributes[key]);
  parent.append(element);
  return element;
}

export class Overlay
{
  constructor(view)
  {
    this.view = view;
    this.root = svg_element(view.element, "svg", { "aria-hidden": "true" });
    this.crosshair = svg_element(this.root, "path", { class: "crosshair" });
    this.marks = { hovered: this.make_mark(""), fixed: this.make_mark(" is-fixed") };
  }

  make_mark(name)
  {
    const group = svg_element(this.root, "g", { class: "mark" + name, visibility: "hidden" });
    return {
      group, halo: svg_element(group, "circle", { class: "halo", r: 7 }), polygon: svg_element(group, "polygon", {}),
      ring: svg_element(group, "circle", { r: 7 })
    };
  }

  // A point and the corners of its triangle, or nothing. What cannot be seen is dashed.
  draw(name, point, corners, is_hidden)
  {
    const mark = this.marks[name];
    mark.group.setAttribute("visibility", point ? "visible" : "hidden");
    if(! point)
      return;
    const [x, y] = this.view.project(point), pixels = corners.map(c => this.view.project(c));
    if(! [x, y, ...pixels.flat()].every(Number.isFinite))
      return mark.group.setAttribute("visibility", "hidden");
    for(const circle of [mark.ring, mark.halo])
    {
      circle.setAttribute("cx", x.toFixed(1));
      circle.setAttribute("cy", y.toFixed(1));
    }
    mark.polygon.setAttribute("points", pixels.map(p => p.map(z => z.toFixed(1)).join()).join(" "));
    mark.group.classList.toggle("is-hidden", is_hidden);
  }

  resize()
  {
    const x = this.view.element.clientWidth / 2, y = this.view.element.clientHeight / 2;
    this.crosshair.setAttribute("d", `M${x - 9} ${y}h18M${x} ${y - 9}v18`);
  }
}
