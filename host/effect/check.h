#pragma once
// What a well-formed file must still satisfy: names that exist, types that fit, scripts that parse.

#include "host/effect/parser.h"

namespace tegument {

/// Parses the scripts into the model, resolves every name (script names get the spelling of their declaration), appends to parsed.errors.
/// `lenient`: what only a host of DXSAS would refuse is a warning; a script's command that cannot be is dropped.
void checkEffect(Parsed& parsed, bool lenient = false);

} // namespace tegument
