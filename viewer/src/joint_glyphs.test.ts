import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import schemaText from '../../schema/model.schema.json?raw';
import { jointGlyph } from './joint_glyphs';

/** The kinds of joints that model files know. */
function kinds(): string[] {
  const schema = JSON.parse(schemaText);
  return Object.keys(schema.properties.joints.additionalProperties.properties);
}

/** What a glyph consists of: shapes and where they stand. */
function parts(glyph: THREE.Object3D): string {
  const found: string[] = [];
  glyph.updateMatrixWorld(true);
  glyph.traverse((object) => {
    if (!(object instanceof THREE.Mesh)) return;
    object.geometry.computeBoundingBox();
    const box = object.geometry.boundingBox!.clone().applyMatrix4(object.matrixWorld);
    const corners = [...box.min.toArray(), ...box.max.toArray()].map((x) => x.toFixed(3));
    found.push(`${object.geometry.type} ${corners.join(' ')}`);
  });
  return found.sort().join('\n');
}

describe('joint glyphs', () => {
  it('exist for every kind of joint, and no two look alike', () => {
    const known = kinds();
    expect(known.length).toBeGreaterThan(20);
    const unknown = parts(jointGlyph('no such joint', 0));
    const looks = new Map<string, string>();
    for (const kind of known) {
      const look = parts(jointGlyph(kind, 0));
      expect(look, kind).not.toBe(unknown);
      expect(looks.get(look), kind).toBeUndefined();
      looks.set(look, kind);
    }
  });

  it('have about the size of a joint, around its place', () => {
    for (const kind of kinds()) {
      const box = new THREE.Box3().setFromObject(jointGlyph(kind, 0));
      expect(box.containsPoint(new THREE.Vector3()), kind).toBe(true);
      expect(box.getSize(new THREE.Vector3()).length(), kind).toBeGreaterThan(1);
      expect(box.getSize(new THREE.Vector3()).length(), kind).toBeLessThan(10);
    }
  });
});
