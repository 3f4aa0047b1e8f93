// Which textures of its material a surface samples: TEXTURES has a bit for each slot.
#pragma once

#include "generated/gpu_interface.glsl"

#define HAS_TEXTURE(slot) ((TEXTURES >> slot & 1) != 0)
