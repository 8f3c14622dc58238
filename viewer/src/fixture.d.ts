declare module '*/tests/fixture.mjs' {
  export const kVariants: Record<
    | 'slider-crank'
    | 'slider-crank-3d'
    | 'tiny'
    | 'far'
    | 'one-frame'
    | 'two-frames'
    | 'no-frames'
    | 'no-bodies'
    | 'no-curves'
    | 'empty'
    | 'broken'
    | 'spatial'
    | 'modes',
    () => unknown
  >;
  export function base64(numbers: number[]): string;
}
