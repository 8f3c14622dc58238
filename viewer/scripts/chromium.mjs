// Debian's Chromium, headless, with WebGL by software; used by the page test and by screenshots.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

const kFlags = [
  '--no-sandbox',
  '--headless=new',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--no-first-run',
];

/** Starts the browser of CHROMIUM, by default /usr/bin/chromium. */
export async function launch() {
  const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
  if (!existsSync(executablePath)) {
    throw new Error(`${executablePath}: no such browser; install chromium or set CHROMIUM`);
  }
  return chromium.launch({ executablePath, args: kFlags, headless: true });
}
