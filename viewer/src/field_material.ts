import * as THREE from 'three';
import { colorTable, type ColorMapName } from './color_map';

/** What the colours of all bodies have in common. */
export class FieldShading {
  readonly uniforms = {
    fieldMap: { value: null as THREE.DataTexture | null },
    fieldLow: { value: 0 },
    fieldHigh: { value: 1 },
    fieldBands: { value: 0 },
    cutLow: { value: -3e38 },
    cutHigh: { value: 3e38 },
    /** 0 shows all, 1 greys out values beyond the limits, 2 hides them. */
    cutMode: { value: 0 },
    noColor: { value: new THREE.Color(0x999999) },
    sectionColor: { value: new THREE.Color(0x777777) },
  };
  private map = '';

  setMap(name: ColorMapName): void {
    if (name === this.map) return;
    this.map = name;
    const texture = new THREE.DataTexture(colorTable(name), 256, 1, THREE.RGBAFormat);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    this.uniforms.fieldMap.value?.dispose();
    this.uniforms.fieldMap.value = texture;
  }
}

const kVertexHead = `
attribute float fieldValue;
varying float vField;
flat varying float vFieldFlat;
#ifdef SPIN
attribute vec2 spinQuarter;
varying vec2 vQuarter;
#endif
`;

const kFragmentHead = `
uniform sampler2D fieldMap;
uniform float fieldLow, fieldHigh, fieldBands, cutLow, cutHigh, cutMode;
uniform float fieldOn, fieldFlat, closedSurface;
uniform vec3 noColor, sectionColor;
varying float vField;
flat varying float vFieldFlat;
#ifdef SPIN
varying vec2 vQuarter;
#endif
`;

const kColor = `
if (fieldOn > 0.5) {
  float value = fieldFlat > 0.5 ? vFieldFlat : vField;
  if (value > 1e30) {
    diffuseColor.rgb = noColor;
  } else {
    bool beyond = value < cutLow || value > cutHigh;
    if (beyond && cutMode > 1.5) discard;
    float s = clamp((value - fieldLow) / max(fieldHigh - fieldLow, 1e-37), 0.0, 1.0);
    if (fieldBands > 0.5) s = (min(floor(s * fieldBands), fieldBands - 1.0) + 0.5) / fieldBands;
    vec3 painted = texture2D(fieldMap, vec2((255.0 * s + 0.5) / 256.0, 0.5)).rgb;
    diffuseColor.rgb = beyond && cutMode > 0.5 ? noColor : painted;
  }
}
#ifdef SPIN
if (vQuarter.x * vQuarter.y > 0.0) diffuseColor.rgb *= 0.7;
#endif
`;

// The inside of a closed surface is seen only through a cut: a plain colour there looks like
// the face of the cut.
const kSection = `
if (closedSurface > 0.5 && !gl_FrontFacing) {
  float hatch = step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 7.0));
  outgoingLight = sectionColor * mix(0.82, 1.0, hatch);
}
`;

/** Paint of a body: one colour, or the colours of a field by the attribute `fieldValue`. */
export class FieldMaterial extends THREE.MeshLambertMaterial {
  private readonly own = {
    fieldOn: { value: 0 },
    fieldFlat: { value: 0 },
    closedSurface: { value: 0 },
  };

  constructor(
    color: THREE.ColorRepresentation,
    private readonly shading: FieldShading,
  ) {
    super({ color });
  }

  override onBeforeCompile(shader: THREE.WebGLProgramParametersWithUniforms): void {
    Object.assign(shader.uniforms, this.shading.uniforms, this.own);
    shader.vertexShader =
      kVertexHead +
      shader.vertexShader.replace(
        '#include <begin_vertex>',
        '#include <begin_vertex>\nvField = fieldValue;\nvFieldFlat = fieldValue;\n' +
          '#ifdef SPIN\nvQuarter = spinQuarter;\n#endif',
      );
    shader.fragmentShader =
      kFragmentHead +
      shader.fragmentShader
        .replace('#include <color_fragment>', `#include <color_fragment>\n${kColor}`)
        .replace('#include <opaque_fragment>', `${kSection}\n#include <opaque_fragment>`);
  }

  override customProgramCacheKey(): string {
    return `field ${'SPIN' in (this.defines ?? {})}`;
  }

  /** Darkens two quarters of a turn, by the attribute `spinQuarter`, so that a spin is visible. */
  showSpin(): void {
    this.defines = { ...this.defines, SPIN: '' };
  }

  /** Colours by values (`flat`: one per face) or plainly. */
  setField(on: boolean, flat: boolean): void {
    this.own.fieldOn.value = on ? 1 : 0;
    this.own.fieldFlat.value = flat ? 1 : 0;
  }

  /** Whether a limit hides a point between three vertices with these values. */
  hides(values: number[], weights: number[]): boolean {
    const { cutMode, cutLow, cutHigh } = this.shading.uniforms;
    if (this.own.fieldOn.value < 0.5 || cutMode.value < 1.5) return false;
    // As in the shader: a face has the value of its last vertex, and unrecorded values are not hidden.
    const mixed = values.reduce((sum, value, k) => sum + weights[k]! * value, 0);
    const value = this.own.fieldFlat.value > 0.5 ? values[2]! : mixed;
    return value <= 1e30 && (value < cutLow.value || value > cutHigh.value);
  }

  /** Whether the back can be seen, and if so whether it is the inside of something closed. */
  setBack(seen: boolean, closed: boolean): void {
    const side = seen ? THREE.DoubleSide : THREE.FrontSide;
    if (this.side !== side) {
      this.side = side;
      this.needsUpdate = true;
    }
    this.own.closedSurface.value = closed ? 1 : 0;
  }
}
