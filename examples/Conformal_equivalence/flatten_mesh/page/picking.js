// What is under a pixel: the triangles are drawn with their numbers for colours, into that pixel alone. So the graphics card does the search, and the
// pixel, not the number of triangles, is what is read back. A picture that is searched again, unchanged, is kept whole, so that a cursor that moves
// over it costs no drawing, however many triangles there are.

import * as THREE from "three";

function make_target(w, h)
{
  return new THREE.WebGLRenderTarget(w, h, {
    format: THREE.RGBAIntegerFormat, type: THREE.UnsignedIntType, internalFormat: "RGBA32UI",
    minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false
  });
}

export class Picker
{
  constructor(renderer)
  {
    this.renderer = renderer;
    this.pixel = make_target(1, 1);
    this.kept = new Map(); // by view: { target, view_number, is_drawn }
    this.result = new Uint32Array(4);
    this.as_floats = new Float32Array(this.result.buffer);
  }

  // The face at a point of the view's element, and barycentric coordinates there; null if there is none.
  pick(view, x, y)
  {
    const w = view.element.clientWidth, h = view.element.clientHeight;
    if(! (x >= 0 && y >= 0 && x < w && y < h))
      return null;
    const kept = this.kept_picture(view, w, h);
    if(kept.is_drawn)
      this.read(kept.target, Math.floor(x), h - 1 - Math.floor(y));
    else
      this.draw(view, this.pixel, w, h, x - .5, y - .5, 1, 1);
    if(this.result[0] === 0)
      return null;
    const a = this.as_floats[1], b = this.as_floats[2];
    return { face: this.result[0] - 1, coordinates: [a, b, 1 - a - b] };
  }

  // Drawn when it is asked for the second time.
  kept_picture(view, w, h)
  {
    const kept = this.kept.get(view) || {};
    this.kept.set(view, kept);
    if(kept.number_of_changes !== view.number_of_changes)
      Object.assign(kept, { number_of_changes: view.number_of_changes, is_drawn: false });
    else if(! kept.is_drawn)
    {
      kept.target ??= make_target(w, h);
      kept.target.setSize(w, h);
      this.draw(view, kept.target, w, h, 0, 0, w, h);
      kept.is_drawn = true;
    }
    return kept;
  }

  draw(view, target, w, h, x, y, width, height)
  {
    view.camera.setViewOffset(w, h, x, y, width, height);
    this.renderer.setRenderTarget(target);
    this.renderer.render(view.pick_scene, view.camera);
    this.renderer.setRenderTarget(null);
    view.camera.clearViewOffset();
    this.read(target, 0, 0);
  }

  read(target, x, y)
  {
    this.renderer.readRenderTargetPixels(target, x, y, 1, 1, this.result);
  }
}
