// Seams, borders, circles and cones: what is drawn over the triangles.

import * as THREE from "three";
import { cone_vertex_shader, cone_fragment_shader } from "./shaders.js";

function positions_of(data, corners, is_plane)
{
  const positions = new Float32Array(3 * corners.length);
  corners.forEach((c, i) => {
    for(let k = 0; k < 3; ++k)
      positions[3 * i + k] = ! is_plane ? data.points[3 * c + k] : k < 2 ? data.layout[2 * c + k] : 0;
  });
  return positions;
}

// Lines as wide as that on the screen, with two positions for each; `colors` alike, or one for all.
function segments(positions, colors, width, is_plane)
{
  const geometry = new THREE.LineSegmentsGeometry();
  geometry.setPositions(positions);
  if(colors)
    geometry.setColors(colors);
  const result = new THREE.LineSegments2(geometry, new THREE.LineMaterial({ linewidth: width, vertexColors: Boolean(colors), depthTest: ! is_plane }));
  result.frustumCulled = false;
  result.renderOrder = 1;
  return result;
}

// On the surface each seam edge is one edge; in the layout it is two, in one colour.
export function make_seams(data, is_plane)
{
  const corners = [], colors = [], palette = data.seamColors.map(c => new THREE.Color().setStyle(c));
  for(let i = 0; i < data.seams.length; i += 5)
    for(const side of is_plane ? [0, 2] : [0])
      for(const end of [0, 1])
      {
        corners.push(data.seams[i + side + end]);
        colors.push(...palette[data.seams[i + 4]].toArray());
      }
  return corners.length ? segments(positions_of(data, corners, is_plane), colors, 2.5, is_plane) : null;
}

// Both sides of all seams, as thin as the border: the outline of a layout whose seams are not shown.
export function make_cut(data)
{
  const corners = [];
  for(let i = 0; i < data.seams.length; i += 5)
    corners.push(...data.seams.subarray(i, i + 4));
  return corners.length ? segments(positions_of(data, corners, true), null, 1.25, true) : null;
}

export function make_border(data, is_plane)
{
  return data.border.length ? segments(positions_of(data, data.border, is_plane), null, 1.25, is_plane) : null;
}

// Given in coordinates of the layout.
export function make_circles(data)
{
  const positions = [], n = 256;
  for(const [x, y, r] of data.circles)
    for(let i = 0; i < n; ++i)
      for(const angle of [2 * Math.PI * i / n, 2 * Math.PI * (i + 1) / n])
        positions.push((x + r * Math.cos(angle) - data.centre[0]) / data.radius, (y + r * Math.sin(angle) - data.centre[1]) / data.radius, 0);
  return positions.length ? segments(positions, null, 1, true) : null;
}

export function make_cones(data, is_plane, uniforms)
{
  const corners = data.cones.flatMap(cone => is_plane ? cone.corners : cone.corners.slice(0, 1));
  if(! corners.length)
    return null;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions_of(data, corners, is_plane), 3));
  const result = new THREE.Points(geometry, new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: cone_vertex_shader, fragmentShader: cone_fragment_shader,
    uniforms: { ...uniforms, is_plane: { value: is_plane } }, transparent: true, depthTest: ! is_plane, depthWrite: false
  }));
  result.frustumCulled = false;
  result.renderOrder = 2;
  return result;
}
