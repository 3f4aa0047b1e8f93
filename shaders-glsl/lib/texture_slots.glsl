// Textures of a material, as TextureSlot numbers them. TEXTURES has a bit for each that is sampled.
#pragma once

#define BASE_COLOR 0
#define METALLIC_ROUGHNESS 1
#define NORMAL 2
#define OCCLUSION 3
#define EMISSIVE 4

#define HAS_TEXTURE(slot) ((TEXTURES >> slot & 1) != 0)
