#include "parts.h"
namespace dsw::rigid {
void run_cost(const Options&, Report&) {}
}  // namespace dsw::rigid
