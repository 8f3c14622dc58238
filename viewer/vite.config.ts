import { defineConfig, type Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const kDataSlot = '<script>window.BUCKENS_DATA = /*BUCKENS_DATA*/null;</script>';

/** The program looks for this text; a build that lost or doubled it is of no use. */
const keepDataSlot: Plugin = {
  name: 'keep-data-slot',
  enforce: 'post',
  generateBundle(_options, bundle) {
    const page = bundle['index.html'];
    const html = page?.type === 'asset' ? String(page.source) : '';
    const [slots, marks] = [kDataSlot, '/*BUCKENS_DATA*/'].map(
      (text) => html.split(text).length - 1,
    );
    if (slots !== 1 || marks !== 1) {
      this.error(`index.html holds ${slots} of "${kDataSlot}" (mark: ${marks}), 1 expected`);
    }
  },
};

// One HTML file without any reference to another file: the page is archived and mailed as it is.
export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), keepDataSlot],
  build: { target: 'es2022', chunkSizeWarningLimit: 1200, reportCompressedSize: false },
});
