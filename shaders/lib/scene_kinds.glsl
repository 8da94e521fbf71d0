// What a scene may contain, as specialisation constants: lavapipe runs the code of every branch, with lanes masked
// off, so that what no material of the scene needs is better left out. Before shared/bsdf.h.
#ifndef PPM_LIB_SCENE_KINDS_GLSL
#define PPM_LIB_SCENE_KINDS_GLSL

#include "shared/bindings.h"

layout(constant_id = PPM_SPEC_ROUGH_GLOSS) const bool kRoughGloss = true;
#define PPM_ROUGH_GLOSS kRoughGloss
layout(constant_id = PPM_SPEC_TEXTURES) const bool kTextures = true;
layout(constant_id = PPM_SPEC_DETAILS) const bool kDetails = false;
layout(constant_id = PPM_SPEC_COVERAGE) const bool kCoverage = false;
layout(constant_id = PPM_SPEC_LAYERS) const bool kLayers = false;
#define PPM_LAYERS kLayers
layout(constant_id = PPM_SPEC_DISPERSION) const bool kDispersion = false;
layout(constant_id = PPM_SPEC_MEDIA) const bool kMedia = true;
layout(constant_id = PPM_SPEC_TEXTURED_LIGHTS) const bool kTexturedLights = true;
layout(constant_id = PPM_SPEC_ENVIRONMENT) const bool kEnvironment = false;

#endif
