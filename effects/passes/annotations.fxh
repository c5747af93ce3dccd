// What the annotations of all effects have in common: the technique that a host starts with.
#ifndef TEGUMENT_PASSES_ANNOTATIONS_FXH
#define TEGUMENT_PASSES_ANNOTATIONS_FXH

// Annotations of `float Script : STANDARDSGLOBAL`. technique: what a host runs that has been told nothing else, a string.
#define STARTS_WITH(technique) \
    string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; \
    string Script = "Technique=" technique ";";

#endif
