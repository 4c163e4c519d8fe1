// Bundles of their own, loaded when they are first needed; build.mjs leaves these names as they are.

export const loadOrbit = () => import("./orbit3d.js");
export const loadEditor = () => import("./editor.js");
