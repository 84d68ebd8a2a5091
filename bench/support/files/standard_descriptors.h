/// The descriptors 0, 1 and 2, which a program may find closed.
#pragma once

namespace touchmark::bench::support {

/// Opens those that are closed, so that no file, socket or shared memory gets their number and is taken for
/// them. What is written to a standard output that was closed fails as it should; messages to a closed
/// standard error go nowhere. Throws ResourceError. To be called before anything is opened.
void reserve_standard_descriptors();

}  // namespace touchmark::bench::support
