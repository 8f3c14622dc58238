import { describe, expect, it } from 'vitest';
import { spinOf } from './spin';
import type { Body } from './run';
import type { Triple } from './page_data';

/** A body that makes `turns` about z in 100 frames. */
function turning(nodes: Triple[], turns: number, markers: Triple[] = []): Body {
  const pose = [...Array(101)].flatMap((_, k) => {
    const half = (Math.PI * turns * k) / 100;
    return [0, 0, 0, Math.cos(half), 0, 0, Math.sin(half)];
  });
  return {
    name: 'b',
    kind: nodes.length ? 'solid' : 'rigid',
    nodes: Float32Array.from(nodes.flat()),
    nodeNumbers: null,
    elements: [],
    radius: [],
    sections: null,
    faces: null,
    markers: markers.map((position) => ({ name: 'm', position, orientation: [1, 0, 0, 0], node: -1 })),
    pose: Float32Array.from(pose),
    displacement: null,
    perNode: 3,
    shape: null,
    motion: null,
    fields: [],
    hasRotations: false,
  };
}

const ring = [...Array(24)].flatMap((_, k): Triple[] => {
  const [c, s] = [Math.cos((Math.PI * k) / 12), Math.sin((Math.PI * k) / 12)];
  return [
    [c, s, -0.1],
    [c, s, 0.1],
    [0.4 * c, 0.4 * s, 0.1],
  ];
});
const box: Triple[] = [-1, 1].flatMap((x) => [-1, 0, 1].flatMap((y): Triple[] => [[x, y, 0], [y, x, 0.5]]));

describe('spinOf', () => {
  it('marks what turns about the axis around which it is round', () => {
    const spin = spinOf(turning(ring, 3))!;
    expect(Math.abs(spin.axis[2])).toBeCloseTo(1, 6);
    const shaft: Triple[] = [0, 1, 2].map((z) => [0, 0, z]);
    expect(spinOf(turning(shaft, 1))).not.toBeNull();
  });

  it('leaves alone what does not turn, and what shows that it does', () => {
    expect(spinOf(turning(ring, 0))).toBeNull();
    expect(spinOf(turning(ring, 0.1))).toBeNull();
    expect(spinOf(turning(box, 3))).toBeNull();
    const off = ring.map(([x, y, z]): Triple => [x + 3, y, z]);
    const wheelOnArm = [...off, [-3, 0, 0] as Triple];
    expect(spinOf(turning(wheelOnArm, 3))).toBeNull();
  });

  it('marks rigid bodies whose markers all lie on the axis', () => {
    expect(spinOf(turning([], 2, [[0, 0, 0.1], [0, 0, -0.2]]))).not.toBeNull();
    expect(spinOf(turning([], 2, [[0, 0, 0.1], [0.3, 0, 0]]))).toBeNull();
    // Without any marker apart it is a box, whose edges show how it turns.
    expect(spinOf(turning([], 2, [[0, 0, 0]]))).toBeNull();
  });
});
