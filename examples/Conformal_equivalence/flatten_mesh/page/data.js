// The data of the page, as arrays: see page_data.h, which writes them.

function bytes(text)
{
  if(Uint8Array.fromBase64) // of browsers since 2025, and much faster
    return Uint8Array.fromBase64(text).buffer;
  const s = atob(text), result = new Uint8Array(s.length);
  for(let i = 0; i < s.length; ++i)
    result[i] = s.charCodeAt(i);
  return result.buffer;
}

// The text is given back to the browser once it is read.
function array_of(Type, id)
{
  const element = document.getElementById("data-" + id), result = new Type(bytes(element.textContent));
  element.remove();
  return result;
}

export function read_data()
{
  const data = JSON.parse(document.getElementById("data-numbers").textContent);
  data.points = array_of(Float32Array, "points");
  data.layout = array_of(Float32Array, "layout");
  data.weights = array_of(Float32Array, "weights");
  data.u = array_of(Float32Array, "u");
  data.triangles = array_of(Uint32Array, "triangles");
  data.area_codes = array_of(Uint16Array, "area-factors");
  data.factor_codes = array_of(Uint16Array, "quasi-conformal-factors");
  data.hidden_edges = array_of(Uint8Array, "hidden-edges");
  data.seams = array_of(Uint32Array, "seams");
  data.border = array_of(Uint32Array, "border");
  data.face_numbers = array_of(Uint32Array, "face-numbers");
  data.number_of_corners = data.u.length;
  data.number_of_faces = data.triangles.length / 3;
  data.has_weights = data.weights.length > 0;
  data.is_sphere = data.distanceOfSpheres > 0;
  return data;
}

export function point_of(data, corner)
{
  return new THREE.Vector3().fromArray(data.points, 3 * corner);
}

export function image_of(data, corner)
{
  return data.is_sphere ? new THREE.Vector3().fromArray(data.layout, 3 * corner) : new THREE.Vector3(data.layout[2 * corner], data.layout[2 * corner + 1], 0);
}

// A corner of the face, 0, 1 or 2.
export function corner_of(data, face, k)
{
  return data.triangles[3 * face + k];
}

// Barycentric coordinates in a triangle of the surface, for those in its image; or back. They are the same if interpolation is linear; in projective
// interpolation they are multiplied by the weights (section 3.4 of the paper).
export function carried_over(data, face, coordinates, to_layout, is_projective)
{
  if(! is_projective || ! data.has_weights)
    return coordinates;
  const result = coordinates.map((x, k) => {
    const w = data.weights[corner_of(data, face, k)];
    return to_layout ? x * w : x / w;
  });
  const sum = result[0] + result[1] + result[2];
  return result.map(x => x / sum);
}

// The direction of a point near a sphere from its centre; it is not normalized.
export function direction_on_sphere(data, point)
{
  const d = data.distanceOfSpheres, p = point.clone().multiplyScalar(data.radius).add(new THREE.Vector3(...data.centre));
  p.x -= d * Math.round(p.x / d);
  p.y -= d * Math.round(p.y / d);
  return p;
}

// The point with these barycentric coordinates: of the surface or of the layout, as `place` says (point_of or image_of).
export function point_in(data, face, coordinates, place)
{
  const result = new THREE.Vector3();
  coordinates.forEach((x, k) => result.addScaledVector(place(data, corner_of(data, face, k)), x));
  return result;
}
