// A diffuse member of a VPL cluster.

const MEMBER_SIZE = 2u;
