// What the annotations of all effects have in common: the technique that a host starts with, the user interface of parameters, sizes and
// formats of targets.
#ifndef TEGUMENT_PASSES_ANNOTATIONS_FXH
#define TEGUMENT_PASSES_ANNOTATIONS_FXH

// Of `float Script : STANDARDSGLOBAL`. technique: what a host runs that has been told nothing else, a string.
#define STARTS_WITH(technique) \
    string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; \
    string Script = "Technique=" technique ";";

// Of parameters of type float. name: a string.
#define UI_SLIDER(name, least, most, step) \
    string UIName = name; string UIWidget = "Slider"; float UIMin = least; float UIMax = most; float UIStep = step;
#define UI_CHECKBOX(name) string UIName = name; string UIWidget = "CheckBox"; float UIMin = 0.0; float UIMax = 1.0;
#define UI_COLOUR(name) string UIName = name; string UIWidget = "Color";

// Of targets: squares of size x size texels, and those of the picture's size. format: a string.
#define SQUARE_TARGET(size, format) int Width = size; int Height = size; int MipLevels = 1; string Format = format;
#define SQUARE_DEPTH(size) int Width = size; int Height = size; string Format = "D24S8";
#define PICTURE_TARGET(format) float2 ViewportRatio = { 1.0, 1.0 }; int MipLevels = 1; string Format = format;
#define PICTURE_DEPTH float2 ViewportRatio = { 1.0, 1.0 }; string Format = "D24S8";

#endif
// SPDX-License-Identifier: MIT
