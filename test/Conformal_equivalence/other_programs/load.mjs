// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Opens files by the loaders of three.js. Each line of the standard input says what has to be found: the file, vertices (or -), faces, and whether
// there are texture coordinates, and a picture.

import { readFileSync } from 'fs';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { MTLLoader } from 'three/examples/jsm/loaders/MTLLoader.js';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';

// What of a browser the loaders ask for: pictures are decoded as far as their size.
globalThis.self = globalThis;
globalThis.createImageBitmap = async blob => {
  const bytes = Buffer.from(await blob.arrayBuffer());
  if(bytes.toString('latin1', 1, 4) !== 'PNG') throw new Error('no PNG picture');
  return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20), close() {} };
};

function bytesOf(file) { const b = readFileSync(file); return b.buffer.slice(b.byteOffset, b.byteOffset + b.length); }

function ofGeometry(geometry)
{
  return { vertices: geometry.attributes.position.count, uv: !! geometry.attributes.uv,
           faces: (geometry.index ? geometry.index.count : geometry.attributes.position.count) / 3 };
}

function ofScene(scene)
{
  let found;
  scene.traverse(o => {
    if(o.isMesh) found = Object.assign(ofGeometry(o.geometry), { picture: !! o.material.map, width: o.material.map?.image?.width });
  });
  return found;
}

async function glb(file)
{
  const scene = ofScene((await new GLTFLoader().parseAsync(bytesOf(file), '')).scene);
  if(scene.picture && ! (scene.width > 0)) throw new Error('the picture is not decoded');
  return scene;
}

// Options of a picture would be part of its name, or move it.
function obj(file)
{
  const text = readFileSync(file, 'utf8'), library = /^mtllib (.*)$/m.exec(text), loader = new OBJLoader();
  let picture = false;
  if(library) {
    const materials = new MTLLoader().parse(readFileSync(library[1], 'utf8'), '');
    const { map_kd, layout } = { ...materials.materialsInfo.layout, layout: materials.materialsInfo.layout };
    const parameters = materials.getTextureParams(map_kd, {});
    if(! layout || parameters.scale.x !== 1 || parameters.scale.y !== 1 || parameters.offset.x !== 0 || parameters.offset.y !== 0)
      throw new Error('the material has options');
    readFileSync(parameters.url);
    picture = true;
  }
  return Object.assign(ofScene(loader.parse(text)), { picture });
}

const readers = { glb, obj, ply: file => Object.assign(ofGeometry(new PLYLoader().parse(bytesOf(file))), { picture: false }) };
let failures = 0, number = 0;
for(const line of readFileSync(0, 'utf8').trim().split('\n')) {
  const [file, vertices, faces, uv, picture] = line.split(' ');
  try {
    const found = await readers[file.split('.').pop()](file);
    const isGood = found.faces === Number(faces) && found.uv === (uv === '1') && found.picture === (picture === '1')
                && (file.endsWith('.obj') || found.vertices === Number(vertices));
    if(! isGood) throw new Error(`found ${JSON.stringify(found)}, not ${line}`);
    ++number;
  }
  catch(e) {
    console.log(`FAILED: three.js: ${file}: ${e.message}`);
    ++failures;
  }
}
console.log(`three.js: ${number} files`);
process.exit(failures ? 1 : 0);
