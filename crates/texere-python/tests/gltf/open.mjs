// Opens a GLB file in Khronos' validator and in glTF-Transform: `node open.mjs FILE`. Prints JSON: the validator's
// report, and each yarn, or each place of a part of a yarn, as glTF-Transform decodes it, with positions in metres in the scene's axes, normals, and attributes.

import { readFileSync } from 'node:fs';
import { NodeIO } from '@gltf-transform/core';
import { EXTMeshGPUInstancing, EXTMeshoptCompression, KHRMeshQuantization } from '@gltf-transform/extensions';
import validator from 'gltf-validator';
import { MeshoptDecoder } from 'meshoptimizer/decoder';

const path = process.argv[2];
const bytes = new Uint8Array(readFileSync(path));
const report = await validator.validateBytes(bytes, { uri: path, maxIssues: 0 });

await MeshoptDecoder.ready;
const io = new NodeIO()
  .registerExtensions([EXTMeshGPUInstancing, EXTMeshoptCompression, KHRMeshQuantization])
  .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });
const document = await io.readBinary(bytes);
const yarns = [];
for (const node of document.getRoot().listNodes()) {
  const matrix = node.getWorldMatrix();
  // A column of the matrix for each axis, and one for the origin.
  const moved = ([x, y, z], origin) =>
    [0, 1, 2].map((row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + origin * matrix[12 + row]);
  for (const place of places(node)) {
    const yarn = { name: node.getName(), positions: [], normals: [], uv: [], tangents: [], numbers: [], indices: [] };
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const first = yarn.positions.length;
      for (const [name, list, origin] of [['POSITION', yarn.positions, 1], ['NORMAL', yarn.normals, 0]]) {
        const accessor = primitive.getAttribute(name);
        for (let vertex = 0; vertex < accessor.getCount(); vertex++) {
          list.push(moved(accessor.getElement(vertex, []).map((own, axis) => own + origin * place[axis]), origin));
        }
      }
      for (const [name, list] of [['TEXCOORD_0', yarn.uv], ['TANGENT', yarn.tangents], ['_YARN', yarn.numbers]]) {
        const accessor = primitive.getAttribute(name);
        for (let vertex = 0; vertex < (accessor?.getCount() ?? 0); vertex++) {
          list.push(accessor.getElement(vertex, []));
        }
      }
      yarn.indices.push(...Array.from(primitive.getIndices().getArray(), (index) => first + index));
    }
    if (yarn.indices.length > 0) yarns.push(yarn);
  }
}

// Where a node's mesh is drawn, in the node's axes.
function places(node) {
  const instances = node.getExtension('EXT_mesh_gpu_instancing')?.getAttribute('TRANSLATION');
  return instances ? Array.from({ length: instances.getCount() }, (_, at) => instances.getElement(at, [])) : [[0, 0, 0]];
}

process.stdout.write(JSON.stringify({ report, yarns }));
