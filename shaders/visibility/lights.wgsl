// The lights that shadow rays go to, word after word of 32.

@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
