#pragma once

namespace tegument {

/// Where this program was started as the driver of Microsoft's compiler it is that, and does not return.
void driveWhereAsked();

} // namespace tegument
