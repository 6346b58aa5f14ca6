// The sockets of a listening address.
#pragma once

#include <vector>

#include "core/descriptor.hpp"
#include "server/listen_address.hpp"

namespace nbvopt {

/// Sockets that listen on an address: one, or one an address of a host's name. They do not block.
/// Fills the port that the system chose for 0 into `address.text`. A Unix socket is its owner's
/// alone; one of that name that is there already, which nobody may be using, is replaced. Throws
/// InputError where that address cannot be had.
std::vector<Descriptor> listen_on(ListenAddress& address);

}  // namespace nbvopt
