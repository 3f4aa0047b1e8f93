// What a picture of radiance holds.
#pragma once

// Half floats end here; a light grazed at R0 may exceed that.
const float MOST_RADIANCE = 65504.0;

// Where light is added to what surfaces radiate without any, neither part may take the sum beyond that.
const float MOST_PART = 0.5 * MOST_RADIANCE;

// Shown where a fragment's cluster is missing (Gelderen figure 5.1).
const vec3 MISSING_CLUSTER = vec3(1.0, 0.0, 1.0);
