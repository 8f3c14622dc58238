import { kClosest } from './camera_rig';
import { numNodes, type Body, type Run } from './run';

/** More parts than this are drawn as plain forms in a few calls; fewer as glyphs of their own. */
const kMany = 1000;
/** Parts of a kind that stay glyphs of their own in a crowd. */
export const kFew = 100;
/** Radius of a joint as a share of how far a typical body reaches. */
const kJointOfReach = 0.25;

/** Whether a run has thousands of parts. */
export function isCrowd(run: Run): boolean {
  return run.bodies.length + run.joints.length + run.shapes.length > kMany;
}

/** Whether a body can be drawn as bars from its origin to its markers. */
export function isPlain(body: Body): boolean {
  return body.kind === 'rigid' && numNodes(body) === 0;
}

/** Nearer, places in single precision would tremble by more than a pixel. */
const kSteady = 1e-4;

/** How near one may go to see joints of this radius well, both as shares of the size of the run. */
export function closestTo(joint: number): number {
  return Math.min(kClosest, Math.max(kSteady, 20 * joint));
}

/** Radius of joints among bodies that are small beside the whole [m]; `usual` where bodies have no extent. */
export function crowdJoint(run: Run, usual: number): number {
  const reaches = run.bodies
    .filter(isPlain)
    .map(({ markers }) => markers.reduce((most, { position }) => Math.max(most, Math.hypot(...position)), 0))
    .filter((reach) => reach > 0)
    .sort((a, b) => a - b);
  const middle = reaches[reaches.length >> 1];
  return middle === undefined ? usual : Math.min(usual, kJointOfReach * middle);
}
