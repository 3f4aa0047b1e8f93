// The material of MATERIAL_WHITE (Tegelaers section 3.1): white Lambert without 1/pi over an even light.
#pragma once

// Of what is shown, the part that no light gives; the sum over lights makes up the rest.
const float WHITE_AMBIENT = 0.1;
