// The triangles, as textures and materials for the graphics card.

import * as THREE from "three";
import { fill_vertex_shader, fill_fragment_shader, pick_fragment_shader, sample_vertex_shader } from "./shaders.js";
import { corner_of } from "./data.js";

const texture_width = 4096; // as in the shaders

// A texture with the given components per texel, filled by `fill(array)`.
function texture_of(Type, components, n, format, type, fill)
{
  const height = Math.max(1, Math.ceil(n / texture_width));
  const array = new Type(components * texture_width * height);
  fill(array);
  const texture = new THREE.DataTexture(array, texture_width, height, format, type);
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

export function make_textures(data)
{
  const { points, layout, u, weights } = data, n = data.number_of_corners, m = data.number_of_faces;
  return {
    triangles: texture_of(Uint32Array, 1, 3 * m, THREE.RedIntegerFormat, THREE.UnsignedIntType, a => a.set(data.triangles)),
    codes: texture_of(Uint16Array, 4, m, THREE.RGBAIntegerFormat, THREE.UnsignedShortType, a => {
      for(let f = 0; f < m; ++f)
      {
        a[4 * f] = data.area_codes[f];
        a[4 * f + 1] = data.factor_codes[f];
        a[4 * f + 2] = data.hidden_edges.length ? data.hidden_edges[f] : 0;
      }
    }),
    places: texture_of(Float32Array, 4, n, THREE.RGBAFormat, THREE.FloatType, a => {
      for(let i = 0; i < n; ++i)
      {
        a[4 * i] = points[3 * i];
        a[4 * i + 1] = points[3 * i + 1];
        a[4 * i + 2] = points[3 * i + 2];
        a[4 * i + 3] = u[i];
      }
    }),
    images: texture_of(Float32Array, 4, n, THREE.RGBAFormat, THREE.FloatType, a => {
      for(let i = 0; i < n; ++i)
      {
        const d = data.is_sphere ? 3 : 2;
        a[4 * i] = layout[d * i];
        a[4 * i + 1] = layout[d * i + 1];
        a[4 * i + 2] = data.is_sphere ? layout[3 * i + 2] : 0;
        a[4 * i + 3] = data.has_weights ? weights[i] : 1;
      }
    })
  };
}

// The number of rows of the largest texture.
export function rows_needed(data)
{
  return Math.ceil(3 * data.number_of_faces / texture_width);
}

// All materials share these, so that one assignment changes both pictures.
export function make_uniforms(data, textures, log_ratio)
{
  const uniforms = {
    strips: { value: [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()] }, number_of_strips: { value: 2 },
    is_sphere: { value: data.is_sphere }, graticule: { value: 10 },
    sphere_centre: { value: new THREE.Vector3(...data.centre) }, sphere_unit: { value: data.radius }, distance_of_spheres: { value: data.distanceOfSpheres },
    is_projective: { value: data.has_weights }, is_wire: { value: false }, mode: { value: 0 },
    area_range: { value: new THREE.Vector2(...data.areaRange) }, factor_range: { value: new THREE.Vector2(...data.factorRange) },
    log_ratio: { value: log_ratio }, range: { value: new THREE.Vector2(0, 1) }, band: { value: new THREE.Vector2(-1e38, 1e38) },
    scale: { value: data.scale.map(c => shader_color(c)) }
  };
  for(const name in textures)
    uniforms[name] = { value: textures[name] };
  for(const name of ["board_light", "board_dark", "accent", "over", "under", "none", "back", "flipped", "ground", "ink"])
    uniforms[name] = { value: new THREE.Vector3() };
  return uniforms;
}

// Colours as they are written: the shaders write them to the canvas unchanged.
export function shader_color(text)
{
  const x = parseInt(text.slice(1), 16);
  return new THREE.Vector3((x >> 16) / 255, (x >> 8 & 255) / 255, (x & 255) / 255);
}

function material(uniforms, is_image, fragmentShader, more)
{
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: fill_vertex_shader, fragmentShader, side: THREE.DoubleSide,
    uniforms: { ...uniforms, is_image: { value: is_image } }, ...more
  });
}

function mesh(data, its_material)
{
  const geometry = new THREE.BufferGeometry();
  geometry.setDrawRange(0, 3 * data.number_of_faces);
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2);
  const result = new THREE.Mesh(geometry, its_material);
  result.frustumCulled = false;
  return result;
}

// Lines lie on the triangles: these are moved away a little.
export function make_fill(data, uniforms, is_image)
{
  return mesh(data, material(uniforms, is_image, fill_fragment_shader, {
    defines: { PATTERN_DX: "dFdx(q)", PATTERN_DY: "dFdy(q)" }, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2
  }));
}

export function make_pickable(data, uniforms, is_image)
{
  return mesh(data, material(uniforms, is_image, pick_fragment_shader, { blending: THREE.NoBlending }));
}

// A point for each pixel of a row, whose colour is that of a point of the layout; see Instrument.sample_pattern().
export function make_samples(uniforms)
{
  const samples = new THREE.Points(new THREE.BufferGeometry(), new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: sample_vertex_shader, fragmentShader: fill_fragment_shader, blending: THREE.NoBlending,
    defines: { IS_SAMPLE: "", PATTERN_DX: "vec2(footprint, 0.)", PATTERN_DY: "vec2(0., footprint)" },
    uniforms: { ...uniforms, is_image: { value: true }, number_of_samples: { value: 1 }, footprint: { value: 0 } }
  }));
  samples.frustumCulled = false;
  return samples;
}

// The corners of a face, as points of the surface or of the layout.
export function corners_of_face(data, face, place)
{
  return [0, 1, 2].map(k => place(data, corner_of(data, face, k)));
}
