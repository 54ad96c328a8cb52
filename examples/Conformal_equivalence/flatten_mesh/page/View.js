// One of the two pictures: its part of the page, its camera, and what it draws. The surface is turned, the layout is moved.

import * as THREE from "three";
import { make_fill, make_pickable } from "./surface.js";
import { make_border, make_circles, make_cones, make_cut, make_seams } from "./lines.js";

// Where one looks from, and what is up.
const directions = { front: [0, 0, 1], back: [0, 0, -1], left: [-1, 0, 0], right: [1, 0, 0], top: [0, 1, 1e-3], bottom: [0, -1, 1e-3] };

const angle_of_view = 28; // degrees

export class View
{
  constructor(element, data, uniforms, cone_uniforms, is_image, on_change)
  {
    const is_plane = is_image && ! data.is_sphere;
    this.element = element;
    this.data = data;
    this.is_image = is_image;
    this.is_plane = is_plane;
    this.is_dirty = true;
    this.number_of_changes = 0; // of what is seen
    this.on_change = on_change;
    this.fill = make_fill(data, uniforms, is_image);
    this.layers = data.is_sphere ? {} : {
      seams: make_seams(data, is_plane), border: make_border(data, is_plane), cones: make_cones(data, is_plane, cone_uniforms),
      circles: is_plane ? make_circles(data) : null, cut: is_plane ? make_cut(data) : null
    };
    this.scene = new THREE.Scene();
    this.scene.add(this.fill);
    for(const layer of Object.values(this.layers))
      if(layer)
        this.scene.add(layer);
    this.pick_scene = new THREE.Scene();
    this.pick_scene.add(make_pickable(data, uniforms, is_image));
    this.camera = is_plane ? new THREE.OrthographicCamera(-1, 1, 1, -1, .1, 10) : new THREE.PerspectiveCamera(angle_of_view, 1, .01, 100);
    this.camera.up.set(0, ...(is_image && ! is_plane ? [0, 1] : [1, 0])); // spheres have their poles on the z-axis
    this.controls = this.make_controls();
    this.extent = this.find_extent();
    this.initial_direction = is_plane ? directions.front : data.is_sphere && is_image ? [1, .6, .6] : this.find_direction();
    this.reset();
  }

  make_controls()
  {
    const controls = new THREE.OrbitControls(this.camera, this.element);
    controls.zoomToCursor = true;
    controls.enableRotate = ! this.is_plane;
    controls.minDistance = .02;
    controls.maxDistance = 60;
    controls.minZoom = .2;
    controls.maxZoom = 1e4;
    if(this.is_plane)
    {
      controls.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };
      controls.touches = { ONE: THREE.TOUCH.PAN, TWO: THREE.TOUCH.DOLLY_PAN };
    }
    controls.addEventListener("change", () => this.changed());
    return controls;
  }

  changed()
  {
    if(! this.is_plane) // as little room before and behind the surface as can be, so that depths are told apart
    {
      const distance = this.camera.position.length();
      this.camera.near = Math.max(.005 * distance, .002, distance - 1.9);
      this.camera.far = distance + 1.9;
      this.camera.updateProjectionMatrix();
    }
    this.is_dirty = true;
    ++this.number_of_changes;
    this.on_change();
  }

  // Of the surface and of spheres the radius about the origin, of the layout half of its width and of its height; with its circles.
  find_extent()
  {
    const { layout: q, circles, centre, radius } = this.data;
    if(! this.is_plane)
    {
      const p = this.is_image ? q : this.data.points;
      let largest = 0;
      for(let i = 0; i < p.length; i += 3)
        if(Number.isFinite(p[i] + p[i + 1] + p[i + 2]))
          largest = Math.max(largest, p[i] ** 2 + p[i + 1] ** 2 + p[i + 2] ** 2);
      return [Math.sqrt(largest) || 1];
    }
    const extent = [1e-3, 1e-3];
    for(let i = 0; i < q.length; ++i)
      if(Number.isFinite(q[i]))
        extent[i & 1] = Math.max(extent[i & 1], Math.abs(q[i]));
    for(const circle of circles)
      for(const k of [0, 1])
        extent[k] = Math.max(extent[k], (Math.abs(circle[k] - centre[k]) + circle[2]) / radius);
    return extent;
  }

  // Sheets are seen from their front, closed surfaces from slightly above.
  find_direction()
  {
    const { points: p, triangles: t } = this.data, sum = new THREE.Vector3(), a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3();
    let total = 0;
    for(let i = 0; i < t.length; i += 3)
    {
      a.fromArray(p, 3 * t[i]);
      b.fromArray(p, 3 * t[i + 1]).sub(a);
      c.fromArray(p, 3 * t[i + 2]).sub(a);
      b.cross(c);
      if(Number.isFinite(b.x + b.y + b.z))
      {
        sum.add(b);
        total += b.length();
      }
    }
    if(! (sum.length() > .15 * total))
      return [.45, .3, 1];
    const d = sum.normalize();
    // a little from the side, so that its shape is seen
    return Math.abs(d.y) > .8 ? [.25, Math.sign(d.y), .7] : [d.x + .3 * d.z, d.y + .2, d.z - .3 * d.x];
  }

  // The whole picture, from one of `directions` or as at first.
  reset(direction)
  {
    const [x, y, z] = directions[direction] || this.initial_direction;
    const c = this.camera;
    this.controls.target.set(0, 0, 0);
    c.zoom = 1;
    this.fit(); // the distance depends on the shape
    c.position.set(x, y, z).setLength(this.is_plane ? 2 : this.distance());
    this.controls.update();
    this.changed();
  }

  distance()
  {
    const aspect = this.camera.aspect || 1, half = angle_of_view / 360 * Math.PI;
    return 1.07 * this.extent[0] / Math.sin(Math.min(half, Math.atan(Math.tan(half) * aspect)));
  }

  // Gives the camera the shape of the element.
  fit()
  {
    const w = this.element.clientWidth || 1, h = this.element.clientHeight || 1, c = this.camera;
    if(this.is_plane)
    {
      const heading = h > 200 ? 30 : 0; // pixels, above what is seen at first; and below, as the origin is in the middle
      const unit = Math.max(1.12 * this.extent[0] / w, 1.06 * this.extent[1] / (h - 2 * heading));
      c.left = -unit * w;
      c.right = unit * w;
      c.top = unit * h;
      c.bottom = -unit * h;
    }
    else
      c.aspect = w / h;
    c.updateProjectionMatrix();
  }

  resize()
  {
    const before = this.is_plane ? 0 : this.distance();
    this.fit();
    if(! this.is_plane) // as much of the surface stays visible
      this.camera.position.sub(this.controls.target).multiplyScalar(this.distance() / before).add(this.controls.target);
    this.controls.update();
    this.changed();
  }

  // Its place in the canvas, in CSS pixels.
  box()
  {
    return { x: this.element.offsetLeft, y: this.element.offsetTop, w: this.element.clientWidth, h: this.element.clientHeight };
  }

  // In pixels of the element.
  project(point)
  {
    const p = point.clone().project(this.camera);
    return [(p.x + 1) / 2 * this.element.clientWidth, (1 - p.y) / 2 * this.element.clientHeight];
  }

  // By shares of the picture: turns the surface or moves the layout.
  step(x, y)
  {
    const c = this.camera, offset = c.position.clone().sub(this.controls.target);
    if(this.is_plane)
    {
      const move = new THREE.Vector3(x * (c.right - c.left) / c.zoom, y * (c.top - c.bottom) / c.zoom, 0);
      c.position.add(move);
      this.controls.target.add(move);
    }
    else
    {
      const upright = c.quaternion.clone().setFromUnitVectors(c.up, new THREE.Vector3(0, 1, 0)), r = offset.applyQuaternion(upright).length();
      const longitude = Math.atan2(offset.x, offset.z) + 2 * x, latitude = Math.max(-1.55, Math.min(1.55, Math.asin(offset.y / r) + 2 * y));
      c.position.set(r * Math.cos(latitude) * Math.sin(longitude), r * Math.sin(latitude), r * Math.cos(latitude) * Math.cos(longitude))
                .applyQuaternion(upright.invert()).add(this.controls.target);
    }
    this.controls.update();
    this.changed();
  }

  zoom(factor)
  {
    if(this.is_plane)
    {
      this.camera.zoom = Math.max(this.controls.minZoom, Math.min(this.controls.maxZoom, this.camera.zoom * factor));
      this.camera.updateProjectionMatrix();
    }
    else
      this.camera.position.sub(this.controls.target).multiplyScalar(1 / factor).add(this.controls.target);
    this.controls.update();
    this.changed();
  }

  // Brings a point into the middle; one on the other side of the surface is turned to the front.
  show(point, normal)
  {
    const c = this.camera, offset = c.position.clone().sub(this.controls.target);
    if(normal && normal.dot(offset) < .3 * offset.length())
      offset.copy(normal).setLength(offset.length());
    this.controls.target.copy(point);
    c.position.copy(point).add(offset);
    this.controls.update();
    this.changed();
  }
}
