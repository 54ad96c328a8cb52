// What is under a pixel: the triangles are drawn with their numbers for colours, into that pixel alone. So the graphics card does the search, and the
// pixel, not the number of triangles, is what is read back.

import * as THREE from "three";

export class Picker
{
  constructor(renderer)
  {
    this.renderer = renderer;
    this.target = new THREE.WebGLRenderTarget(1, 1, {
      format: THREE.RGBAIntegerFormat, type: THREE.UnsignedIntType, internalFormat: "RGBA32UI",
      minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false
    });
    this.result = new Uint32Array(4);
    this.as_floats = new Float32Array(this.result.buffer);
  }

  // The face at a point of the view's element, and barycentric coordinates there; null if there is none.
  pick(view, x, y)
  {
    const { renderer, target } = this, w = view.element.clientWidth, h = view.element.clientHeight;
    if(! (x >= 0 && y >= 0 && x < w && y < h))
      return null;
    view.camera.setViewOffset(w, h, x - .5, y - .5, 1, 1);
    renderer.setRenderTarget(target);
    renderer.render(view.pick_scene, view.camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, this.result);
    renderer.setRenderTarget(null);
    view.camera.clearViewOffset();
    if(this.result[0] === 0)
      return null;
    const a = this.as_floats[1], b = this.as_floats[2];
    return { face: this.result[0] - 1, coordinates: [a, b, 1 - a - b] };
  }
}
