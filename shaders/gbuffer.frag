#version 460
layout(location = 0) flat in uvec2 id;
layout(location = 0) out uvec2 outId;

void main() { outId = id; }
