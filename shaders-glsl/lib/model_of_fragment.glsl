// The model that the running fragment is of: the index of its instance (see geometry/surface.vert).
#pragma once

layout(location = 5) flat in uint model_of_fragment;
