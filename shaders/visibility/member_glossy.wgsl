// A member of a VPL cluster with a Phong lobe: its third and fourth texel have the lobe's direction and
// shininess, and its weight and peak.

const MEMBER_SIZE = 4u;
