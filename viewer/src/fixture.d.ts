declare module '*/tests/fixture.mjs' {
  import type { PageRows, PageRun } from './page_data';
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
    | 'modes'
    | 'solid'
    | 'crowd',
    () => PageRun
  >;
  export function base64(numbers: ArrayLike<number>): string;
  export function ints(numbers: ArrayLike<number>): string;
  export function rows(numbers: ArrayLike<number>): PageRows;
  export function coded(numbers: ArrayLike<number>, width: number): PageRows;
}

declare module '*/tests/chain_fixture.mjs' {
  import type { PageRun } from './page_data';
  export function chain(links: number): PageRun;
}
