// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Functions that test_page.mjs has evaluated in the page: each as a text, so they know nothing of one another. `flatten_mesh_page` is the
// page's Instrument.

export async function started()
{
  const late = Date.now() + 30000;
  while(! globalThis.flatten_mesh_page?.number_of_frames)
  {
    if(Date.now() > late)
      throw new Error("the page does not begin: " + document.getElementById("note").textContent);
    await new Promise(resolve => setTimeout(resolve, 20));
  }
}

export function symmetry()
{
  return flatten_mesh_page.data.symmetry;
}

// Colours of five points of every seam edge, on both sides. `moved`: by so many strips.
export function compare_seams(parts, moved)
{
  const page = flatten_mesh_page, { seams, layout } = page.data, left = [], right = [];
  page.set_pattern_size(1 - Math.log(parts) / Math.log(64));
  page.uniforms.strips.value.forEach(s => { s.z += moved; });
  const between = (a, b, t) => [0, 1].map(k => (1 - t) * layout[2 * a + k] + t * layout[2 * b + k]);
  for(let i = 0; i < seams.length; i += 5)
    for(const t of [.07, .29, .5, .73, .91])
    {
      left.push(...between(seams[i], seams[i + 1], t));
      right.push(...between(seams[i + 2], seams[i + 3], t));
    }
  // a twentieth of a strip is blurred, so that rounding in single precision changes colours by little
  const s = page.uniforms.strips.value[0], footprint = .05 / Math.hypot(s.x, s.y);
  const a = page.sample_pattern(new Float32Array(left), footprint), b = page.sample_pattern(new Float32Array(right), footprint);
  const result = { samples: a.length / 4, differing: 0, light: 0, dark: 0 };
  for(let i = 0; i < a.length; i += 4)
  {
    // in the blur of an edge, the pattern is as steep as it gets: 180 levels over a twentieth of a strip
    if([0, 1, 2].some(k => Math.abs(a[i + k] - b[i + k]) > 12))
      ++result.differing;
    result[a[i] > 160 ? "light" : "dark"] += 1;
  }
  return result;
}

// Centroids of large triangles of the layout: the pixels there, and samples.
export async function compare_with_picture()
{
  const page = flatten_mesh_page, { data, layout: view } = page, points = [], pixels = [];
  const lines = Object.values(view.layers).filter(x => x?.visible);
  lines.forEach(x => { x.visible = false; });
  view.is_dirty = true;
  page.draw();
  const gl = page.renderer.getContext(), ratio = page.renderer.getPixelRatio(), box = view.box(), pixel = new Uint8Array(4);
  for(let f = 0; f < data.number_of_faces; f += Math.ceil(data.number_of_faces / 400))
  {
    const p = [0, 1].map(k => [0, 1, 2].reduce((sum, i) => sum + data.layout[2 * data.triangles[3 * f + i] + k] / 3, 0));
    const [x, y] = view.project(page.surface.camera.position.clone().set(...p, 0));
    gl.readPixels(Math.floor((box.x + x) * ratio), gl.drawingBufferHeight - 1 - Math.floor((box.y + y) * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    points.push(...p);
    pixels.push(pixel[0]);
  }
  const unit = 2 * view.camera.top / box.h, samples = page.sample_pattern(new Float32Array(points), 3 * unit);
  let compared = 0, differing = 0;
  pixels.forEach((x, i) => { // away from the edges of the pattern
    const sample = samples[4 * i];
    if(sample > 240 || sample < 80)
    {
      ++compared;
      differing += Math.abs(sample - x) > 8;
    }
  });
  lines.forEach(x => { x.visible = true; });
  page.redraw();
  return { compared, differing };
}

// A grid of pixels of both pictures: how far from the pixel the point found is drawn.
export function pick_everywhere()
{
  const page = flatten_mesh_page, result = { hits: 0, misses: 0, largest_error: 0 };
  for(const view of page.views)
    for(let i = .5; i < 8; ++i)
      for(let j = .5; j < 8; ++j)
      {
        const x = i / 8 * view.element.clientWidth, y = j / 8 * view.element.clientHeight, mark = page.find(view, { x, y });
        if(! mark)
        {
          ++result.misses;
          continue;
        }
        ++result.hits;
        const [p, q] = view.project(page.place_in(view, mark));
        result.largest_error = Math.max(result.largest_error, Math.hypot(p - x, q - y));
      }
  return result;
}

// How often triangles are drawn to find what is under a cursor that moves over a picture.
export function drawings_of_search()
{
  const page = flatten_mesh_page, { renderer } = page, render = renderer.render;
  let number = 0;
  renderer.render = (...values) => { ++number; return render.apply(renderer, values); };
  for(let i = 0; i < 20; ++i)
    page.find(page.layout, { x: page.layout.element.clientWidth / 2 + i, y: page.layout.element.clientHeight / 2 });
  renderer.render = render;
  return number;
}

// How many colours there are among pixels of a row through the middle of the pictures, as they were drawn last; and what the note says.
export function drawn_at_once()
{
  const page = globalThis.flatten_mesh_page, note = document.getElementById("note").textContent;
  if(! page)
    return { note, colors: 0 };
  const gl = page.renderer.getContext(), pixels = new Uint8Array(4 * gl.drawingBufferWidth);
  gl.readPixels(0, gl.drawingBufferHeight >> 1, gl.drawingBufferWidth, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return { note, colors: new Set(new Uint32Array(pixels.buffer)).size };
}

// Whether everything in the header is in one row, and each group of it in one line.
export async function header()
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const middle = x => { const box = x.getBoundingClientRect(); return Math.round(box.top + box.height / 2); };
  const rows = items => Math.max(...items.map(middle)) - Math.min(...items.map(middle));
  const groups = [...document.querySelectorAll(".choices")].filter(x => x.children.length);
  return { rows: rows([...document.querySelector("header").children].filter(x => x.children.length || x.textContent)),
           lines: Math.max(...groups.map(x => rows([...x.children]))), toggles: document.getElementById("toggles").children.length,
           overflow: document.documentElement.scrollWidth - innerWidth };
}

export function middle_of(id)
{
  const box = document.getElementById(id).getBoundingClientRect();
  return [Math.round(box.left + box.width / 2), Math.round(box.top + box.height / 2)];
}

// The mark's triangle or -1, how far from the middle of each picture it is, and what is read.
export async function marks(name)
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const page = flatten_mesh_page, mark = page[name], numbers = page.data.face_numbers;
  const result = { face: mark ? mark.face : -1, number: mark && String(numbers.length ? numbers[mark.face] : mark.face), reading: {}, is_shown: {} };
  for(const item of document.querySelectorAll("#reading div"))
    result.reading[item.querySelector("dt").textContent] = item.querySelector("dd")?.textContent;
  for(const id of ["surface", "layout"])
  {
    const group = page.overlays.get(page[id]).marks[name].group, ring = group.querySelector("circle:last-child"), element = page[id].element;
    result.is_shown[id] = group.getAttribute("visibility") === "visible";
    result[id] = [ring.getAttribute("cx") - element.clientWidth / 2, ring.getAttribute("cy") - element.clientHeight / 2];
  }
  return result;
}

export async function camera(id)
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const { position, zoom } = flatten_mesh_page[id].camera;
  return [...position.toArray().map(x => x.toFixed(6)), zoom];
}

export function focus(id)
{
  document.getElementById(id).focus();
}

export async function state()
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const page = flatten_mesh_page, { counts, below, above, none } = page.histogram.counts;
  return {
    mode: page.mode, band: page.uniforms.band.value.toArray(), range: page.quantity?.range, number_of_faces: page.data.number_of_faces,
    histogram_total: counts.reduce((a, b) => a + b, 0) + below + above + none
  };
}

export async function layout_point()
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  return flatten_mesh_page.hovered.on_layout.toArray();
}

// The pictures, without text, a fourth as large.
export async function canvas_image()
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const source = document.getElementById("canvas"), canvas = document.createElement("canvas");
  canvas.width = 200;
  canvas.height = Math.round(200 * source.clientHeight / source.clientWidth);
  const g = canvas.getContext("2d");
  g.imageSmoothingQuality = "high";
  g.drawImage(source, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL();
}

// The mean difference of the channels from another such image, as a part of their range.
export async function difference_from(url)
{
  await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const source = document.getElementById("canvas"), image = new Image();
  image.src = url;
  await image.decode();
  const pixels = x => {
    const canvas = document.createElement("canvas"), g = canvas.getContext("2d");
    canvas.width = image.width;
    canvas.height = image.height;
    g.imageSmoothingQuality = "high";
    g.drawImage(x, 0, 0, canvas.width, canvas.height);
    return g.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const a = pixels(source), b = pixels(image);
  let sum = 0;
  for(let i = 0; i < a.length; ++i)
    sum += Math.abs(a[i] - b[i]);
  return sum / a.length / 255;
}

export async function corner_is_dark(is_expected)
{
  const page = flatten_mesh_page, gl = page.renderer.getContext(), pixel = new Uint8Array(4);
  for(let i = 0; i < 50; ++i)
  {
    gl.readPixels(2, 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    if((pixel[0] < 80) === is_expected)
      return true;
    await new Promise(resolve => setTimeout(resolve, 20));
  }
  return false;
}

export async function fitting()
{
  for(let i = 0; i < 3; ++i)
    await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const canvas = document.getElementById("canvas"), surface = document.getElementById("surface"), layout = document.getElementById("layout");
  return { overflow: document.documentElement.scrollWidth - innerWidth, pixels: canvas.width, width: canvas.clientWidth,
           is_stacked: layout.getBoundingClientRect().top >= surface.getBoundingClientRect().bottom - 1 };
}

export async function refusal()
{
  const note = document.getElementById("note"), late = Date.now() + 10000;
  while(note.textContent.startsWith("Loading") && Date.now() < late)
    await new Promise(resolve => setTimeout(resolve, 20));
  const figures = document.getElementById("figures");
  return { note: note.textContent, figures: figures.hidden ? "" : figures.textContent };
}
