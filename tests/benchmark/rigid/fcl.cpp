#include "parts.h"
namespace dsw::rigid {
void run_fcl(const Options&, Report&) {}
}  // namespace dsw::rigid
