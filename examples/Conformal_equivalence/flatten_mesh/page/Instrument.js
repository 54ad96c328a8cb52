// The two pictures together: what is shown in them, what is under the cursor, and when they are drawn anew.

import * as THREE from "three";
import { carried_over, direction_on_sphere, image_of, point_in, point_of } from "./data.js";
import { evaluate, make_quantities, number_text } from "./quantities.js";
import { corners_of_face, make_samples, make_textures, make_uniforms } from "./surface.js";
import { View } from "./View.js";
import { Overlay } from "./Overlay.js";
import { Picker } from "./picking.js";

export const modes = ["pattern", "u", "area", "quasi-conformal"];

const many_faces = 300000; // where one search more per frame would be felt, and triangles are as small as pixels, so that smooth edges show nothing

// The smallest and the largest squares on the surface, and those at first, where the surface is 2 long.
const square_sizes = { least: .004, most: 1, first: .09 };
const most_parts_of_tile = 64;
const graticules = [1, 2, 3, 5, 6, 10, 15, 18, 30, 45]; // degrees that divide 90

export class Instrument
{
  constructor(data, canvas, surface_element, layout_element, reading)
  {
    this.data = data;
    this.reading = reading;
    this.quantities = make_quantities(data);
    THREE.ColorManagement.enabled = false; // colours are written as they are given
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: data.number_of_faces < many_faces, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setScissorTest(true);
    this.uniforms = make_uniforms(data, make_textures(data), this.quantities.log_ratio);
    this.cone_uniforms = { inside: { value: new THREE.Vector3() }, rim: { value: new THREE.Vector3() }, size: { value: 10 } };
    const make_view = (element, is_image) => new View(element, data, this.uniforms, this.cone_uniforms, is_image, () => this.schedule());
    this.surface = make_view(surface_element, false);
    this.layout = make_view(layout_element, true);
    this.views = [this.surface, this.layout];
    this.overlays = new Map(this.views.map(v => [v, new Overlay(v)]));
    this.picker = new Picker(this.renderer);
    this.hovered = this.fixed = null; // { face, on_surface, on_layout, hidden }: `hidden` has the views that do not show it
    this.cones_of_corners = new Map(data.cones.flatMap(cone => cone.corners.map(c => [c, cone])));
    for(const view of this.views)
      this.listen(view);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.set_pattern_size(this.first_pattern_size());
  }

  // ---- when it is drawn

  schedule()
  {
    this.frame ??= requestAnimationFrame(() => { this.frame = null; this.draw(); });
  }

  redraw()
  {
    for(const view of this.views)
      view.is_dirty = true;
    this.schedule();
  }

  resize()
  {
    const canvas = this.renderer.domElement, ratio = Math.min(devicePixelRatio || 1, 3), size = [canvas.clientWidth, canvas.clientHeight, ratio].join();
    if(size === this.size) // an observer tells it at first, too
      return;
    this.size = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    this.cone_uniforms.size.value = 11 * ratio;
    for(const view of this.views)
    {
      view.resize();
      this.overlays.get(view).resize();
    }
    this.draw();
  }

  draw()
  {
    if(this.sought)
      this.hover(this.sought);
    this.sought = null;
    const height = this.renderer.domElement.clientHeight;
    const moved = this.views.filter(view => view.is_dirty && ! view.is_plane);
    for(const view of this.views)
    {
      if(! view.is_dirty)
        continue;
      view.is_dirty = false;
      const { x, y, w, h } = view.box();
      this.renderer.setViewport(x, height - y - h, w, h);
      this.renderer.setScissor(x, height - y - h, w, h);
      this.renderer.render(view.scene, view.camera);
    }
    if(this.data.number_of_faces < many_faces)
      for(const view of moved)
        for(const mark of [this.hovered, this.fixed])
          if(mark)
            this.find_whether_hidden(mark, view);
    for(const view of this.views)
      for(const name of ["hovered", "fixed"])
        this.draw_mark(view, name);
    this.number_of_frames = (this.number_of_frames || 0) + 1;
  }

  draw_mark(view, name)
  {
    const mark = this[name], overlay = this.overlays.get(view);
    if(! mark)
      return overlay.draw(name, null);
    overlay.draw(name, this.place_in(view, mark), corners_of_face(this.data, mark.face, view.is_image ? image_of : point_of), mark.hidden.has(view));
  }

  place_in(view, mark)
  {
    return view.is_image ? mark.on_layout : mark.on_surface;
  }

  // ---- what is under the cursor

  listen(view)
  {
    const element = view.element;
    let pressed = null;
    element.addEventListener("pointermove", e => {
      if(e.buttons === 0 && e.pointerType !== "touch")
      {
        this.sought = { view, ...this.place_of(view, e) };
        this.schedule();
      }
    });
    element.addEventListener("pointerleave", () => { this.sought = null; this.set_mark("hovered", null); });
    element.addEventListener("pointerdown", e => { pressed = { x: e.clientX, y: e.clientY }; });
    element.addEventListener("pointerup", e => {
      const is_click = pressed && Math.hypot(e.clientX - pressed.x, e.clientY - pressed.y) < 5 && e.button === 0;
      pressed = null;
      if(is_click && ! e.target.closest("button"))
        this.fix(this.find(view, this.place_of(view, e)));
    });
    element.addEventListener("dblclick", e => { if(! e.target.closest("button")) this.show_fixed(); });
  }

  place_of(view, event)
  {
    const box = view.element.getBoundingClientRect();
    return { x: event.clientX - box.left - view.element.clientLeft, y: event.clientY - box.top - view.element.clientTop };
  }

  // What is at a place of the view, as a mark.
  find(view, { x, y })
  {
    const found = this.picker.pick(view, x, y);
    return found && this.mark_of(found.face, found.coordinates, view);
  }

  // A point of a face, by its coordinates in `view`.
  mark_of(face, coordinates, view)
  {
    const { data } = this, is_projective = this.uniforms.is_projective.value;
    const other = carried_over(data, face, coordinates, ! view.is_image, is_projective);
    const [in_space, in_plane] = view.is_image ? [other, coordinates] : [coordinates, other];
    const mark = { face, on_surface: point_in(data, face, in_space, point_of), on_layout: point_in(data, face, in_plane, image_of), hidden: new Set() };
    for(const other of this.views)
      if(other !== view && ! other.is_plane)
        this.find_whether_hidden(mark, other);
    return mark;
  }

  find_whether_hidden(mark, view)
  {
    mark.hidden[this.is_hidden(mark, view) ? "add" : "delete"](view);
  }

  // Whether something of the surface or of the sphere is in front of it.
  is_hidden(mark, view)
  {
    const place = this.place_in(view, mark), [x, y] = view.project(place), found = this.picker.pick(view, x, y);
    if(! found || found.face === mark.face)
      return false;
    const { camera } = view, seen = point_in(this.data, found.face, found.coordinates, view.is_image ? image_of : point_of);
    const distance = place.distanceTo(camera.position);
    return seen.distanceTo(camera.position) < .995 * distance && seen.distanceTo(place) > .01 * distance;
  }

  hover({ view, x, y })
  {
    this.set_mark("hovered", this.find(view, { x, y }));
  }

  fix(mark)
  {
    this.set_mark("fixed", mark);
  }

  set_mark(name, mark)
  {
    this[name] = mark;
    for(const view of this.views)
      this.draw_mark(view, name);
    const read = this.hovered || this.fixed;
    this.reading.show(read && this.describe(read.face, read));
    this.histogram.set_tick(read && this.quantity ? this.quantity.of(read.face) : null);
  }

  // The fixed point in the middle of both pictures.
  show_fixed()
  {
    if(! this.fixed)
      return;
    for(const view of this.views)
    {
      const [a, b, c] = corners_of_face(this.data, this.fixed.face, view.is_image ? image_of : point_of);
      view.show(this.place_in(view, this.fixed), view.is_plane ? null : b.sub(a).cross(c.sub(a)).normalize());
    }
  }

  // Fixes the next of the cones.
  show_cone(step)
  {
    const { data } = this, n = data.cones.length;
    if(n === 0)
      return;
    this.cone = this.cone === undefined ? (step > 0 ? 0 : n - 1) : (this.cone + step + n) % n;
    const i = data.triangles.indexOf(data.cones[this.cone].corners[0]), face = Math.floor(i / 3);
    this.fix(this.mark_of(face, [0, 1, 2].map(k => Number(k === i % 3)), this.layout));
    this.show_fixed();
  }

  // Names and texts.
  describe(face, mark)
  {
    const { data, quantities } = this;
    const original = (p, centre, radius, n) => p.toArray().slice(0, n).map((x, k) => number_text(centre[k] + radius * x)).join(", ");
    const cone = [0, 1, 2].map(k => this.cones_of_corners.get(data.triangles[3 * face + k])).find(Boolean);
    return [
      ["Triangle", String(data.face_numbers.length ? data.face_numbers[face] : face)],
      ["u", quantities.u.text(quantities.u.of(face))],
      ["Area factor", quantities.area.text(quantities.area.of(face))],
      ["Quasi-conformal", number_text(quantities["quasi-conformal"].of(face))],
      ["Surface", original(mark.on_surface, data.surfaceCentre, data.surfaceRadius, 3)],
      data.is_sphere ? ["Latitude, longitude", this.angles_text(mark.on_layout)] : ["Layout", original(mark.on_layout, data.centre, data.radius, 2)],
      ...(cone ? [["Cone", `${number_text(cone.angle)}\u00b0, vertex ${cone.vertex}`]] : [])
    ];
  }

  angles_text(point)
  {
    const { x, y, z } = direction_on_sphere(this.data, point), degrees = t => number_text(t / Math.PI * 180) + "\u00b0";
    return `${degrees(Math.atan2(z, Math.hypot(x, y)))}, ${degrees(Math.atan2(y, x))}`;
  }

  // ---- what is shown

  set_mode(mode)
  {
    this.mode = mode;
    this.uniforms.mode.value = modes.indexOf(mode);
    this.quantity = mode === "pattern" ? null : evaluate(this.quantities[mode], this.data.number_of_faces);
    this.set_band(null);
    if(this.quantity)
    {
      this.uniforms.range.value.set(...this.quantity.range);
      this.histogram.show(this.quantity);
    }
    this.set_mark("hovered", this.hovered);
    this.redraw();
  }

  set_band(band)
  {
    this.uniforms.band.value.set(...(band || [-3e38, 3e38]));
    this.redraw();
  }

  set_layer(name, is_shown)
  {
    for(const view of this.views)
      if(view.layers[name])
        view.layers[name].visible = is_shown;
    if(name === "seams" && this.layout.layers.cut)
      this.layout.layers.cut.visible = ! is_shown;
    this.redraw();
  }

  set_wire(is_shown)
  {
    this.uniforms.is_wire.value = is_shown;
    this.redraw();
  }

  set_projective(is_projective)
  {
    this.uniforms.is_projective.value = is_projective;
    this.redraw();
  }

  // ---- the pattern

  first_pattern_size()
  {
    if(this.data.is_sphere)
      return graticules.indexOf(10) / (graticules.length - 1);
    return this.data.symmetry ? 1 : Math.log(square_sizes.first / square_sizes.least) / Math.log(square_sizes.most / square_sizes.least);
  }

  // `size` goes from 0 to 1, on a logarithmic scale. It is the length of squares on the surface, in the mean, so that it means the same whatever the
  // scale of the layout is. A seamless layout has tiles, and its pattern whole parts of them.
  set_pattern_size(size)
  {
    this.pattern_size = size;
    this.pattern_text = this.data.is_sphere ? this.set_graticule(graticules[Math.round(size * (graticules.length - 1))])
                      : this.data.symmetry ? this.set_tiles(Math.round(most_parts_of_tile ** (1 - size))) : this.set_squares(size);
    this.redraw();
    return this.pattern_text;
  }

  set_graticule(degrees)
  {
    this.uniforms.graticule.value = degrees;
    return `latitudes and longitudes ${degrees}\u00b0 apart`;
  }

  set_squares(size)
  {
    const length = square_sizes.least * (square_sizes.most / square_sizes.least) ** size;
    const side = length * Math.exp(this.quantities.areas.log_length_ratio);
    this.set_strips([[1, 0], [0, 1]], 1 / side, [0, 0]);
    return `squares ${number_text(Number((length * this.data.surfaceRadius).toPrecision(3)))} long on the surface, in the mean`;
  }

  // The motions across seams turn about points of the lattice by multiples of 360 / symmetry degrees, and move by points of the lattice. They map strips
  // to strips of the same kind if each strip has points of the lattice in its middle, and if strips are even where those about the origin are,
  // counted together: two strips per unit of the square lattice; a strip for each row of the hexagonal one. So do strips that are narrower by a whole number.
  set_tiles(parts)
  {
    const { symmetry, centre, radius } = this.data, is_hexagonal = symmetry % 3 === 0;
    const directions = is_hexagonal ? [30, 90, 150].map(a => [Math.cos(a / 180 * Math.PI), Math.sin(a / 180 * Math.PI)]) : [[1, 0], [0, 1]];
    const density = parts * (is_hexagonal ? 2 / Math.sqrt(3) : 2);
    this.set_strips(directions, density * radius, directions.map(d => density * (d[0] * centre[0] + d[1] * centre[1])));
    return is_hexagonal ? `${parts === 1 ? "a hexagon" : parts + " hexagons"} along a tile` : `${2 * parts} squares along a tile`;
  }

  set_strips(directions, density, offsets)
  {
    directions.forEach((d, i) => this.uniforms.strips.value[i].set(density * d[0], density * d[1], offsets[i] - 2 * Math.floor(offsets[i] / 2)));
    this.uniforms.number_of_strips.value = directions.length;
  }

  // ---- for tests

  // The colours, four bytes each, of points of the layout in coordinates of the page, as pixels of the size `footprint` would have them.
  sample_pattern(points, footprint)
  {
    const n = points.length / 2, result = new Uint8Array(4 * n), most = 4096, scene = new THREE.Scene();
    this.samples ??= make_samples(this.uniforms);
    scene.add(this.samples);
    this.samples.material.uniforms.footprint.value = footprint;
    for(let begin = 0; begin < n; begin += most)
    {
      const m = Math.min(most, n - begin), target = new THREE.WebGLRenderTarget(m, 1, { depthBuffer: false });
      const geometry = new THREE.BufferGeometry(), pixels = new Uint8Array(4 * m);
      geometry.setAttribute("sample_point", new THREE.BufferAttribute(points.slice(2 * begin, 2 * (begin + m)), 2));
      geometry.setDrawRange(0, m);
      this.samples.geometry = geometry;
      this.samples.material.uniforms.number_of_samples.value = m;
      this.renderer.setRenderTarget(target);
      this.renderer.render(scene, this.layout.camera);
      this.renderer.readRenderTargetPixels(target, 0, 0, m, 1, pixels);
      this.renderer.setRenderTarget(null);
      result.set(pixels, 4 * begin);
      geometry.dispose();
      target.dispose();
    }
    return result;
  }
}
