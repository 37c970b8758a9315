// The page needs no server: paths are relative, and the worker is inside the script.
export default {
  base: './',
  build: {
    target: 'es2022',
    modulePreload: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
  worker: { format: 'iife' },
}
