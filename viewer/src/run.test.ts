import { describe, expect, it } from 'vitest';
import { kVariants, base64, coded, rows } from '../tests/fixture.mjs';
import { checkPage, decodeFloats, decodeRun, PageDataError } from './run';

const fresh = () => kVariants['slider-crank']();

describe('decodeFloats', () => {
  it('reads little-endian float32', () => {
    // 1.5 = 0x3fc00000, −2 = 0xc0000000
    const text = btoa('\x00\x00\xc0\x3f\x00\x00\x00\xc0');
    expect([...decodeFloats(text, 2, 'x')]).toEqual([1.5, -2]);
  });

  it('names the field whose count is wrong', () => {
    expect(() => decodeFloats(base64([1, 2, 3]), 2, 'time.f32')).toThrow(
      'time.f32: 3 numbers found, 2 expected',
    );
  });

  it('refuses what is not base64', () => {
    expect(() => decodeFloats('%%%', 1, 'bodies[0].pose')).toThrow(
      'bodies[0].pose: not valid base64',
    );
    expect(() => decodeFloats(null, 1, 'bodies[0].pose')).toThrow(PageDataError);
  });
});

describe('decodeRun', () => {
  it('keeps every part of a run', () => {
    const run = decodeRun(fresh());
    expect(run.times).toHaveLength(400);
    expect(run.times[399]).toBeCloseTo(0.1, 7);
    expect(run.bodies.map((body) => body.name)).toEqual(['crank', 'rod', 'slider']);
    expect(run.bodies[1]!.displacement).toMatchObject({ frames: 400, width: 13 * 6 });
    expect(run.bodies[1]!.fields.map((field) => field.name)).toEqual(['von_mises', 'section_moment']);
    expect(run.loads[0]).toMatchObject({ name: 'push', width: 3 });
    expect(run.bodies[1]!.hasRotations).toBe(true);
    expect(run.bodies[0]!.hasRotations).toBe(false);
    expect(run.joints).toHaveLength(5);
    expect(run.sensors[1]!.values).toHaveLength(1200);
    expect(run.planar).toBe('xy');
  });

  it('counts steps along a static path, not seconds', () => {
    expect(decodeRun(fresh()).clock).toBe('s');
    const path = { ...fresh(), summary: { static_path: { load_factor: 1 } } };
    expect(decodeRun(path).clock).toBe('steps');
  });

  it('takes bars for straight, also where zeros were rounded', () => {
    const data = fresh();
    const bar = data.bodies[1]!;
    const still = [...Array(400 * 13)].flatMap((_, i) => [-1e-3, 2e-3 * (i % 13), 1e-4, 0, 0, 0]);
    bar.displacement = coded(still, 78);
    expect(decodeRun(data).bodies[1]!.hasRotations).toBe(false);
    bar.displacement = coded(still.map((x, i) => (i % 6 === 5 ? 1e-4 : x)), 78);
    expect(decodeRun(data).bodies[1]!.hasRotations).toBe(true);
  });

  it('takes runs without frames, bodies or curves', () => {
    expect(decodeRun(kVariants['no-frames']()).times).toHaveLength(0);
    expect(decodeRun(kVariants['no-bodies']()).bodies).toHaveLength(0);
    expect(decodeRun(kVariants['no-curves']()).sensors).toHaveLength(0);
  });

  it('refuses an unfilled page, another format, no run, time that runs backwards, missing nodes', () => {
    expect(() => checkPage(null)).toThrow('holds no run');
    expect(() => checkPage({ format: 1, runs: [] })).toThrow('format 1');
    expect(() => checkPage({ format: 2, runs: [] })).toThrow('0 found');
    expect(checkPage({ format: 2, runs: [fresh(), fresh()] })).toHaveLength(2);
    const backwards = { ...fresh(), time: { n: 2, f32: base64([1, 0]) }, bodies: [], joints: [] };
    expect(() => decodeRun(backwards)).toThrow('time: decreases at frame 1');
    const wrong = fresh();
    wrong.bodies[1]!.elements.push([3, 99]);
    expect(() => decodeRun(wrong)).toThrow('bodies[1].elements: no node 3 or 99');
    const loose = fresh();
    loose.joints[0]!.between[1]!.body = 7;
    expect(() => decodeRun(loose)).toThrow('joints[0]: no body 7');
    const astray = fresh();
    astray.loads![0]!.body = 3;
    expect(() => decodeRun(astray)).toThrow('loads[0]: no body 3');
    const short = fresh();
    short.bodies[1]!.fields![0]!.values = rows([1, 2]);
    expect(() => decodeRun(short)).toThrow('bodies[1].von_mises: 2 numbers found, 4800 expected');
  });
});
