// A diffuse member of a VPL cluster.

const MEMBER_TEXELS = 2u;
