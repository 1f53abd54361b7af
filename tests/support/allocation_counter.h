#pragma once

namespace support {

// How many times any code of this process has called malloc or one of its
// relatives, which is what operator new and Eigen do. Linking this counts.
long NumAllocations();

}  // namespace support
