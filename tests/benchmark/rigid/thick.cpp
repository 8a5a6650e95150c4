#include "parts.h"
namespace dsw::rigid {
bool run_thick(const Options&, Report&) { return true; }
}  // namespace dsw::rigid
