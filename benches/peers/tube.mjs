// three.js TubeGeometry on the same polylines: `node tube.mjs FOLDER ROUNDS`.
import { readFileSync } from "node:fs";
import { Curve, TubeGeometry, Vector3 } from "three";

const [folder, rounds] = [process.argv[2], Number(process.argv[3])];
const points = new Float32Array(new Uint8Array(readFileSync(`${folder}/points.f32`)).buffer);
const offsets = new BigUint64Array(new Uint8Array(readFileSync(`${folder}/offsets.u64`)).buffer);

class Polyline extends Curve {
  constructor(first, count) {
    super();
    Object.assign(this, { first, count });
  }
  getPoint(t, target = new Vector3()) {
    const at = t * (this.count - 1);
    const here = Math.min(Math.floor(at), this.count - 2);
    const [a, b, share] = [3 * (this.first + here), 3 * (this.first + here + 1), at - here];
    return target.set(...[0, 1, 2].map((k) => points[a + k] + (points[b + k] - points[a + k]) * share));
  }
  // Its own, so that three.js measures no arc lengths.
  getPointAt(t, target) {
    return this.getPoint(t, target);
  }
  getTangentAt(t, target) {
    return this.getTangent(t, target);
  }
}

const times = [];
let triangles = 0;
for (let round = 0; round < rounds; round++) {
  triangles = 0;
  const meshes = [];
  const start = performance.now();
  for (let yarn = 0; yarn + 1 < offsets.length; yarn++) {
    const [first, count] = [Number(offsets[yarn]), Number(offsets[yarn + 1] - offsets[yarn])];
    const mesh = new TubeGeometry(new Polyline(first, count), count - 1, 0.125, 6, false);
    triangles += mesh.index.count / 3;
    meshes.push(mesh);
  }
  times.push(performance.now() - start);
}
times.sort((a, b) => a - b);
const time = times[Math.floor(times.length / 2)] / 1e3;
const peak = process.resourceUsage().maxRSS / 1024;
console.log(`three.js: ${(triangles / time / 1e6).toFixed(1)} M triangles/s, allocation included; peak ${peak.toFixed(0)} MiB`);
