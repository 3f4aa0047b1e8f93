// Nodes of linked light lists (Örtegren and Persson section 4.4), in `light_indices`; `list_offsets` has the first node of each list.
//
//   NODE_WORDS 2  a word of kind (8 bits) and light (24), and one of the next node
//   NODE_WORDS 1  light (12 bits) and next node (20); of the 12 the paper gives two to the kind, which here the light itself tells
#pragma once

#include "generated/gpu_interface.glsl"

#if NODE_WORDS == 2
const uint NO_NODE = 0xFFFFFFFFu;
#else
const uint NO_NODE = 0xFFFFFu;
#endif

// Set in the word of a point, so that lists that are sorted by it have spots first; without it the word is the light.
const uint KIND_OF_POINT = 1u << 24;
const uint LIGHT_OF_NODE = KIND_OF_POINT - 1u;
