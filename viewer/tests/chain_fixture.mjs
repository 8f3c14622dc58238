// A run of many rigid bodies: a chain along x, each link of which turns by a right angle about z, around its own centre.
import { base64 } from './encoding.mjs';

export function chain(links) {
  const half = Math.SQRT1_2;
  const poses = (k) => [k, 0, 0, 1, 0, 0, 0, k, 2, 0, half, 0, 0, half];
  const marker = (name, x) => ({ name, position: [x, 0, 0], orientation: [1, 0, 0, 0], node: -1 });
  return {
    title: 'Chain',
    version: '',
    generated: '',
    time: { n: 2, f32: base64([0, 1]) },
    bodies: Array.from({ length: links }, (_, k) => ({
      name: `link_${k}`,
      kind: 'rigid',
      nodes: '',
      elements: [],
      radius: [],
      markers: [marker('a', -0.5), marker('b', 0.5)],
      pose: base64(poses(k)),
      displacement: null,
    })),
    joints: Array.from({ length: links }, (_, k) => ({
      name: `pin_${k}`,
      type: 'revolute',
      between: [
        { body: k - 1, marker: k ? 1 : -1, position: [k ? 0.5 : -0.5, 0, 0] },
        { body: k, marker: 0, position: [-0.5, 0, 0] },
      ],
      axis: [0, 0, 1],
      force: base64([0, k, 0, 0, k, 0]),
      torque: null,
    })),
    gravity: [0, -9.81, 0],
    planar: 'xy',
    sensors: [],
    energies: [],
    summary: { rigid_bodies: links },
  };
}

/** A chain in four waves that sway, links of one metre along it. */
export function wavyChain(links) {
  const frames = 11;
  const poses = Array.from({ length: links }, () => []);
  for (let frame = 0; frame < frames; frame++) {
    let [x, y] = [0, 0];
    for (let k = 0; k < links; k++) {
      const angle = 1.1 * Math.cos((Math.PI * frame) / 10) * Math.sin((8 * Math.PI * k) / links);
      const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
      poses[k].push(x + dx / 2, y + dy / 2, 0, Math.cos(angle / 2), 0, 0, Math.sin(angle / 2));
      [x, y] = [x + dx, y + dy];
    }
  }
  const run = chain(links);
  return {
    ...run,
    title: `Chain of ${links} links`,
    time: { n: frames, f32: base64(Array.from({ length: frames }, (_, i) => i)) },
    bodies: run.bodies.map((body, k) => ({ ...body, pose: base64(poses[k]) })),
    joints: run.joints.map((joint) => ({ ...joint, force: null })),
    planar: null,
  };
}
