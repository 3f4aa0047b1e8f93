// Candidates among the lights, a bit each. A workgroup takes LIGHT_BLOCK lights, a word of bits a thread; behind all words
// lies, for each block, how many candidates it has.
#pragma once

#include "generated/gpu_interface.glsl"

uint light_words()
{
    return (grid.light_count + 31u) / 32u;
}

// Where the number of a block's candidates lies.
uint block_count(uint block)
{
    return light_words() + block;
}
