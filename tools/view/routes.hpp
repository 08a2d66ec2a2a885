// From HTTP, as the library reads it, to a Handler.
#pragma once

#include "view/handler.hpp"

namespace httplib {
class Server;
}

namespace hmlfc::view {

/// Lets `handler`, which must outlive `server`, answer every GET and POST with at most 8 KiB of
/// address and 1 KiB of body.
void add_routes(httplib::Server& server, Handler& handler);

}  // namespace hmlfc::view
