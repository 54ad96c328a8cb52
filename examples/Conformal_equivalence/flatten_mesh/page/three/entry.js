// What the page takes from three.js. scripts/bundle_three makes three.js of this folder from it.
export {
  BufferAttribute, BufferGeometry, Color, ColorManagement, DataTexture, DoubleSide, FloatType, GLSL3, LinearSRGBColorSpace, Mesh, MOUSE,
  NearestFilter, NoBlending, OrthographicCamera, PerspectiveCamera, Points, RawShaderMaterial, RedIntegerFormat, RGBAFormat,
  RGBAIntegerFormat, Scene, Sphere, TOUCH, UnsignedIntType, UnsignedShortType, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
export { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
export { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
export { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
