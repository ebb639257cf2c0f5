// The kinds of strata: see src/render/lights/strata.rs. The others are of the environment.

const AREA_LIGHT = 0u;
const SPHERE_LIGHT = 1u;
const DELTA_LIGHT = 4u;
