// Targets of vertices that do not move are not read: their memory cannot be.
#include "body_support.h"

#if defined(__unix__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace dsw::oracle {
namespace {

/// Rows of targets, each on a page of its own. Only those of some vertices can be read.
class GuardedRows {
 public:
#if defined(__unix__)
  GuardedRows(const std::vector<Vec>& rows, const std::vector<uint32_t>& readable)
      : stride(static_cast<size_t>(sysconf(_SC_PAGESIZE))), size_(stride * rows.size()) {
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    for (size_t i = 0; i < rows.size(); ++i) std::memcpy(page(i), rows[i].data(), sizeof rows[i]);
    mprotect(memory_, size_, PROT_NONE);
    for (const uint32_t i : readable) mprotect(page(i), stride, PROT_READ);
  }
  ~GuardedRows() { munmap(memory_, size_); }
  GuardedRows(const GuardedRows&) = delete;
  GuardedRows& operator=(const GuardedRows&) = delete;

  const double* rows() const { return static_cast<const double*>(memory_); }
  const size_t stride;

 private:
  char* page(size_t i) { return static_cast<char*>(memory_) + stride * i; }

  size_t size_;
  void* memory_ = nullptr;
#endif
};

class UnreadTargetsTest : public BodyTest {};

TEST_F(UnreadTargetsTest, OfVerticesThatDoNotMove) {
#if !defined(__unix__)
  GTEST_SKIP() << "no pages that cannot be read";
#else
  const BodyPlan plan = ball({2, 2, 1.5}, 1.2, 80);
  const std::vector<uint32_t> order = {3, 40, 41, 117};
  std::vector<Vec> targets = plan.at;
  for (Vec& p : targets) p = {p[0] + 0.1, p[1] + 0.02, p[2] - 0.13};
  const GuardedRows guarded(targets, order);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.order = order.data();
  options.order_count = order.size();
  for (const dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    for (const uint32_t flags :
         {0u, uint32_t{DSW_BODY_SEQUENCES}, uint32_t{DSW_BODY_SKIP_BY_ENVIRONMENT},
          uint32_t{DSW_BODY_SKIP_BY_CLEARANCE}, uint32_t{DSW_BODY_SKIP_SIMILAR_MOTION},
          uint32_t{DSW_BODY_SELF_CONTACTS}, uint32_t{DSW_BODY_SKIP_BACK_EDGES}, uint32_t{DSW_BODY_NO_SEQUENCES},
          uint32_t{DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES}}) {
      SCOPED_TRACE("level " + std::to_string(level) + " flags " + std::to_string(flags));
      std::string moved;
      for (const bool is_guarded : {false, true}) {
        scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
        const dsw_body_id body = make(plan, level, flags);
        ASSERT_FALSE(HasFailure());
        const double* const rows = is_guarded ? guarded.rows() : targets[0].data();
        const size_t stride = is_guarded ? guarded.stride : 0;
        ASSERT_EQ(dsw_body_move(scene(), body, rows, targets.size(), stride, &options, nullptr), DSW_STATUS_OK)
            << dsw_last_error_message();
        if (!is_guarded) moved = bits_of(read(body));
        EXPECT_EQ(bits_of(read(body)), moved);
      }
    }
  }
#endif
}

}  // namespace
}  // namespace dsw::oracle
