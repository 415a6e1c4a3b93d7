#version 450
flat in uint bit;
layout(location = 0) out uint bits;

void main() { bits = bit; }
