/** Colours the 3-D view and the curves share; the page's own colours are in style.css. */

export interface Theme {
  dark: boolean;
  background: string;
  grid: string;
  text: string;
  muted: string;
  joint: string;
  ghost: string;
  /** Element edges on coloured faces. */
  edge: string;
  bodies: string[];
  curves: string[];
}

export const kLight: Theme = {
  dark: false,
  background: '#f3f5f8',
  grid: '#8b97a8',
  text: '#1b2430',
  muted: '#5b6776',
  joint: '#4a5563',
  ghost: '#6b7787',
  edge: '#1b2430',
  bodies: ['#2f6fb3', '#d5822b', '#4c9a5a', '#8a63b5', '#c2504a', '#2f9aa0', '#b59a2c', '#7c6a5d'],
  curves: ['#1f6fc0', '#d2691e', '#2c8a49', '#8452b8', '#c23b48', '#17889a', '#8a7413', '#5b6776'],
};

const kDark: Theme = {
  dark: true,
  background: '#14181e',
  grid: '#5c6878',
  text: '#e5eaf1',
  muted: '#97a3b3',
  joint: '#b4bfcc',
  ghost: '#9aa7b8',
  edge: '#05080c',
  bodies: ['#5b9be0', '#eea04c', '#6dbb7a', '#ab88d8', '#e0746c', '#4fbcc2', '#d3ba4e', '#a8968a'],
  curves: ['#62a8f0', '#f0a050', '#67c07c', '#b596e8', '#f0808a', '#4cc3d4', '#d8c050', '#a8b4c4'],
};

export type ThemeChoice = 'auto' | 'light' | 'dark';

const kQuery = '(prefers-color-scheme: dark)';
const kStored = 'buckens-theme';

let chosen: ThemeChoice = 'auto';
const listeners: ((theme: Theme) => void)[] = [];

export function themeChoice(): ThemeChoice {
  return chosen;
}

export function currentTheme(): Theme {
  const dark = chosen === 'auto' ? matchMedia(kQuery).matches : chosen === 'dark';
  return dark ? kDark : kLight;
}

/** The page's own colours depend on an attribute of the root; see style/base.css. */
function apply(): void {
  const theme = currentTheme();
  document.documentElement.dataset.theme = theme.dark ? 'dark' : 'light';
  for (const react of listeners) react(theme);
}

/** Follows the system, or not; stored if the browser allows storage for pages from files. */
export function chooseTheme(choice: ThemeChoice): void {
  chosen = choice;
  try {
    localStorage.setItem(kStored, choice);
  } catch {
    // Then it is not stored.
  }
  apply();
}

export function startTheme(): void {
  try {
    const stored = localStorage.getItem(kStored);
    if (stored === 'light' || stored === 'dark') chosen = stored;
  } catch {
    // System setting.
  }
  apply();
  matchMedia(kQuery).addEventListener('change', apply);
}

export function onThemeChange(react: (theme: Theme) => void): void {
  listeners.push(react);
}

/** Light, dark, then the system setting. */
export function nextTheme(): void {
  const next = { auto: 'light', light: 'dark', dark: 'auto' } as const;
  chooseTheme(next[themeChoice()]);
}
