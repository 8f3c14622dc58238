// Time of the processor for the shapes and colours of one picture, without a browser:
//   npm run frame-cost -- [TRIANGLES]
// Counted is the time of this process, so that other work on the machine does not disturb it.
import { BodyField } from '../src/body_field';
import { BodyMotion } from '../src/motion';
import { decodeRun } from '../src/run';
import { Surface } from '../src/surface';
import { VertexValues } from '../src/surface_values';
import type { PageRun } from '../src/page_data';
// @ts-expect-error plain JavaScript
import { largeTorus } from '../tests/large_fixture.mjs';

const triangles = Number(process.argv[2] ?? 200000);
const frames = 20;
const across = Math.round(Math.sqrt(triangles / 8));
const around = Math.round(triangles / 2 / across);
const run = decodeRun(largeTorus({ around, across, frames }) as PageRun);
const spent = () => process.cpuUsage().user / 1000;

let before = spent();
const body = run.bodies[0]!;
const surface = new Surface(body);
console.log(`${2 * around * across} triangles: topology once ${(spent() - before).toFixed(0)} ms`);

const motion = new BodyMotion(body);
const field = new BodyField(body);
const values = new VertexValues(surface, body.faces!);
const out = new Float32Array(surface.nodeOf.length);
const picture = (index: number, fraction: number) => {
  motion.set({ index, fraction });
  surface.deform(motion.displacement, 5);
  values.fill(field.at('von_mises', false, false, { index, fraction })!, out);
};
before = spent();
for (let k = 0; k < frames; k++) picture(k, 0);
console.log(`first sight of a frame, decoded then: ${((spent() - before) / frames).toFixed(1)} ms`);
before = spent();
for (let k = 0; k < 100; k++) picture(k % (frames - 1), 0.5);
console.log(`every further picture: ${((spent() - before) / 100).toFixed(1)} ms`);
