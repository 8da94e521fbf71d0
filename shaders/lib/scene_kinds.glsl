// What a scene may contain, as specialisation constants: lavapipe runs the code of every branch, with lanes masked
// off, so that what no material of the scene needs is better left out. Before shared/bsdf.h.
//
// Drivers parse a kernel's whole text before they know the constants, and do so anew at every start. For scenes that
// need none of the costly kinds there are kernels compiled with PPM_PLAIN_SCENE, where nothing of these is left.
#ifndef PPM_LIB_SCENE_KINDS_GLSL
#define PPM_LIB_SCENE_KINDS_GLSL

#include "shared/bindings.h"

layout(constant_id = PPM_SPEC_ROUGH_GLOSS) const bool kRoughGloss = true;
#define PPM_ROUGH_GLOSS kRoughGloss
layout(constant_id = PPM_SPEC_MEDIA) const bool kMedia = true;

#ifdef PPM_PLAIN_SCENE
const bool kTextures = false;
const bool kDetails = false;
const bool kCoverage = false;
const bool kLayers = false;
const bool kDispersion = false;
const bool kTexturedLights = false;
const bool kEnvironment = false;
#else
layout(constant_id = PPM_SPEC_TEXTURES) const bool kTextures = true;
layout(constant_id = PPM_SPEC_DETAILS) const bool kDetails = false;
layout(constant_id = PPM_SPEC_COVERAGE) const bool kCoverage = false;
layout(constant_id = PPM_SPEC_LAYERS) const bool kLayers = false;
layout(constant_id = PPM_SPEC_DISPERSION) const bool kDispersion = false;
layout(constant_id = PPM_SPEC_TEXTURED_LIGHTS) const bool kTexturedLights = true;
layout(constant_id = PPM_SPEC_ENVIRONMENT) const bool kEnvironment = false;
#endif
#define PPM_LAYERS kLayers

#endif
