/**
 * Values of elements as values at their ends, so that colours run along a beam without steps.
 *
 * The recorded value of an element is the larger one of its ends. Where it grows along the beam, the
 * smaller value of the two elements at a node is that of the node, and so is that of a peak at a
 * node. The larger end of an element always has the element's own value: nothing recorded is hidden,
 * and a jump at a load stays a jump.
 */
export class LineEnds {
  /** By end: the ends of other elements at the same node, where there is exactly one. */
  private readonly next: Int32Array;
  private readonly out: Float32Array;

  constructor(elements: [number, number][]) {
    const at = new Map<number, number[]>();
    elements.forEach((nodes, e) => {
      nodes.forEach((node, k) => at.set(node, [...(at.get(node) ?? []), 2 * e + k]));
    });
    this.next = new Int32Array(2 * elements.length).fill(-1);
    this.out = new Float32Array(2 * elements.length);
    for (const ends of at.values()) {
      if (ends.length !== 2) continue;
      [this.next[ends[0]!], this.next[ends[1]!]] = [ends[1]!, ends[0]!];
    }
  }

  /** Two values per element; those returned last change. */
  fill(values: Float32Array): Float32Array {
    const { next, out } = this;
    for (let e = 0; e < values.length; e++) {
      const own = values[e]!;
      const at = (end: number) => {
        const other = next[end]! < 0 ? own : values[next[end]! >> 1]!;
        return other < own ? other : own;
      };
      let [a, b] = [at(2 * e), at(2 * e + 1)];
      // A free end continues the line.
      if (next[2 * e]! < 0 && b >= own) a = this.beyond(2 * e + 1, own, values);
      if (next[2 * e + 1]! < 0 && a >= own) b = this.beyond(2 * e, own, values);
      if (a < own && b < own) {
        if (a > b) a = own;
        else b = own;
      }
      [out[2 * e], out[2 * e + 1]] = [a, b];
    }
    return out;
  }

  /** At the free end of an element whose other end has its value: on a line with the next element. */
  private beyond(inner: number, own: number, values: Float32Array): number {
    const end = this.next[inner]!;
    if (end < 0) return own;
    const after = values[end >> 1]!;
    return Math.min(own, Math.max(0, 2 * own - after));
  }
}
