// What runs on the graphics card. Nothing is sent to it per frame but a few numbers: the corners of triangles are fetched from textures by
// their numbers, so that surface, layout and the search for what is under the cursor share one copy of the data, and every point knows its
// triangle and its place in it.

const fetch_code = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform usampler2D triangles, codes; // the numbers of corners; of each face the codes of its two factors, and its hidden edges
uniform sampler2D places, images;    // (x, y, z, u), and (s, t, 0, weight) or, on spheres, (x, y, z, 1), of each corner
uniform bool is_image, is_projective;
const int width = 4096;              // of the textures
ivec2 texel(int i) { return ivec2(i % width, i / width); }
`;

export const fill_vertex_shader = fetch_code + `
out vec3 place;            // as seen by the camera
out highp vec4 image;      // homogeneous coordinates in the layout or near the sphere
out vec3 barycentric;
out float u;
flat out int face;
flat out uvec4 code;
void main()
{
  int corner = int(texelFetch(triangles, texel(gl_VertexID), 0).r);
  vec4 p = texelFetch(places, texel(corner), 0);
  vec4 q = texelFetch(images, texel(corner), 0);
  float w = is_projective && ! is_image ? q.w : 1.;
  image = vec4(q.xyz * w, w);
  u = p.w;
  face = gl_VertexID / 3;
  code = texelFetch(codes, texel(face), 0);
  int k = gl_VertexID - 3 * face;
  barycentric = vec3(k == 0, k == 1, k == 2);
  vec4 seen = modelViewMatrix * vec4(is_image ? q.xyz : p.xyz, 1.);
  place = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

// The pattern: strips of even width in two directions make squares, in three directions hexagons with triangles between them. For seamless
// layouts every turn and every translation of the lattice maps the pattern to itself; see Instrument.js, which chooses the strips.
const pattern_code = `
uniform vec3 strips[3];   // the i-th coordinate across strips is dot(xy, image) + z; a strip is one wide, and one has its middle at the origin
uniform int number_of_strips;
uniform vec3 board_light, board_dark;
float strip(float x, float blur) { return clamp((abs(fract(x * .5) * 2. - 1.) - .5) / max(blur, 1e-5) + .5, 0., 1.); }
vec3 pattern(vec2 q, vec2 dx, vec2 dy)
{
  float odd = 0., blur = 0.;
  for(int i = 0; i < number_of_strips; ++i)
  {
    float pixel = length(vec2(dot(strips[i].xy, dx), dot(strips[i].xy, dy)));
    float s = strip(dot(strips[i].xy, q) + strips[i].z, pixel);
    odd = odd + s - 2. * odd * s;
    blur = max(blur, pixel);
  }
  return mix(board_light, board_dark, mix(odd, .5, smoothstep(.7, 1.6, blur)));
}`;

// On spheres: lines of latitude and longitude, some degrees apart, with the poles on the z-axis; the equator and the half circle of longitude 0 are marked.
// Differences of angles are found from those of points, as longitudes leap by 360 degrees.
const graticule_code = `
uniform vec3 sphere_centre;         // of what is drawn
uniform float sphere_unit, distance_of_spheres, graticule;
uniform vec3 accent;
float line(float angle, float step, float pixel, float width)
{
  float away = abs(fract(angle / step + .5) - .5) * step;
  return (1. - smoothstep(width - .5, width + .5, away / max(pixel, 1e-6))) * (1. - smoothstep(.15, .4, pixel / step));
}
vec3 graticule_color(vec3 q)
{
  vec3 d = q * sphere_unit + sphere_centre;
  d.xy -= distance_of_spheres * round(d.xy / distance_of_spheres);
  vec3 dx = dFdx(q) * sphere_unit, dy = dFdy(q) * sphere_unit;
  float r = max(length(d.xy), 1e-6), square = max(dot(d, d), 1e-12);
  float latitude = degrees(atan(d.z, r)), longitude = degrees(atan(d.y, d.x));
  float east = degrees(length(vec2(d.x * dx.y - d.y * dx.x, d.x * dy.y - d.y * dy.x)) / (r * r));
  vec3 n = vec3(-d.xy * d.z / r, r) / square; // the gradient of the latitude
  float north = degrees(length(vec2(dot(n, dx), dot(n, dy))));
  // near the poles, where meridians crowd, only some reach on
  float step = abs(latitude) > 90. - graticule ? 90. : graticule;
  vec3 c = mix(board_light, board_dark, .75 * max(line(latitude, graticule, north, .7), line(longitude, step, east, .7)));
  return mix(c, accent, max(abs(latitude) < 1. ? line(latitude, 180., north, 1.5) : 0., abs(longitude) < 90. ? line(longitude, 180., east, 1.5) : 0.));
}`;

export const fill_fragment_shader = `
precision highp float;
precision highp int;
` + pattern_code + graticule_code + `
in vec3 place;
in highp vec4 image;
in vec3 barycentric;
in float u;
flat in int face;
flat in uvec4 code;
#ifdef IS_SAMPLE
uniform float footprint;        // of a sample; that of a pixel is found by differences
#endif
uniform bool is_image, is_sphere, is_wire;
uniform int mode;               // 0 pattern, 1 u, 2 area factor, 3 quasi-conformal factor
uniform vec2 area_range, factor_range; // of the codes
uniform float log_ratio;
uniform vec2 range, band;       // of what is shown, and of what is not faded
uniform vec3 scale[9], over, under, none, back, flipped, ground, ink;
out vec4 color;

float decoded(uint c, vec2 r) { return r.x + (float(c) - 1.) / 65533. * (r.y - r.x); }

float value()
{
  if(mode == 1) return u;
  if(mode == 2) return (decoded(code.r, area_range) - log_ratio) / log(2.);
  return exp(decoded(code.g, factor_range));
}

vec3 scale_color(float v)
{
  uint c = mode == 2 ? code.r : code.g;
  if(mode != 1 && c == 0u) return none;
  if(mode != 1 && c == 65535u || v > range.y) return over;
  if(v < range.x) return under;
  float t = clamp((v - range.x) / (range.y - range.x), 0., 1.) * 8.;
  int i = min(int(t), 7);
  return mix(scale[i], scale[i + 1], t - float(i));
}

// Edges are as wide as a pixel; they fade where they would cover everything.
float wire()
{
  vec3 d = fwidth(barycentric);
  vec3 at_edge = 1. - smoothstep(d * .4, d * 1.2, barycentric); // opposite to each corner
  if((code.b & 1u) != 0u) at_edge.z = 0.;
  if((code.b & 2u) != 0u) at_edge.x = 0.;
  if((code.b & 4u) != 0u) at_edge.y = 0.;
  float coarse = max(d.x, max(d.y, d.z));
  return max(at_edge.x, max(at_edge.y, at_edge.z)) * (1. - smoothstep(.2, .7, coarse));
}

void main()
{
  vec3 in_layout = image.xyz / image.w;
  vec2 q = in_layout.xy;
  vec3 c;
  if(mode == 0 && is_sphere)
    c = graticule_color(in_layout);
  else if(mode == 0)
    c = pattern(q, PATTERN_DX, PATTERN_DY);
  else
  {
    float v = value();
    c = scale_color(v);
    if(v < band.x || v > band.y) c = mix(c, ground, .82);
  }
#ifndef IS_SAMPLE
  if(is_image && ! is_sphere)
  {
    if(! gl_FrontFacing) c = flipped;
  }
  else
  {
    vec3 n = normalize(cross(dFdx(place), dFdy(place)));
    float light = abs(dot(n, normalize(place)));
    if(! gl_FrontFacing) c = mix(back, c, .3);
    c *= .42 + .6 * light;
  }
  if(is_wire) c = mix(c, ink, .45 * wire());
#endif
  color = vec4(c, 1.);
}`;

// The triangle under the cursor, and where in it.
export const pick_fragment_shader = `
precision highp float;
precision highp int;
in vec3 barycentric;
flat in int face;
out uvec4 found;
void main() { found = uvec4(uint(face) + 1u, floatBitsToUint(barycentric.x), floatBitsToUint(barycentric.y), 0u); }`;

// Tests see the colours of given points of the layout by the shader above, one pixel each.
export const sample_vertex_shader = `
precision highp float;
precision highp int;
in vec2 sample_point;
uniform float number_of_samples;
out vec3 place;
out highp vec4 image;
out vec3 barycentric;
out float u;
flat out int face;
flat out uvec4 code;
void main()
{
  place = barycentric = vec3(0.);
  image = vec4(sample_point, 0., 1.);
  u = 0.;
  face = 0;
  code = uvec4(0u);
  gl_PointSize = 1.;
  gl_Position = vec4((float(gl_VertexID) + .5) / number_of_samples * 2. - 1., 0., 0., 1.);
}`;

export const cone_vertex_shader = `
precision highp float;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform float size;
uniform bool is_plane;
in vec3 position;
void main()
{
  vec4 seen = modelViewMatrix * vec4(position, 1.);
  if(! is_plane) seen.xyz *= .99; // before the surface that it lies on, at the same place of the picture
  gl_Position = projectionMatrix * seen;
  gl_PointSize = size;
}`;

export const cone_fragment_shader = `
precision highp float;
uniform vec3 inside, rim;
uniform float size;
out vec4 color;
void main()
{
  float r = length(gl_PointCoord * 2. - 1.);
  color = vec4(mix(inside, rim, smoothstep(.55 - 2. / size, .55 + 2. / size, r)), 1. - smoothstep(1. - 3. / size, 1., r));
}`;
