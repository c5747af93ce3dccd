#pragma once
// What a well-formed file must still satisfy: names that exist, types that fit, scripts that parse.

#include "host/effect/parser.h"

namespace tegument {

/// Parses the scripts into the model, resolves every name (script names get the spelling of their declaration), appends to parsed.errors.
void checkEffect(Parsed& parsed);

} // namespace tegument
