#pragma once
// A function as an argument that does not make its callee a template: one copy of a long search serves all callers.

#include <memory>
#include <type_traits>
#include <utility>

namespace dsw {

template <class Function>
class FunctionRef;

/** Refers to a function object, which must outlive the reference. Two words; a call costs what an indirect call costs. */
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Function, class = std::enable_if_t<!std::is_same_v<std::decay_t<Function>, FunctionRef>>>
  FunctionRef(Function&& function) noexcept  // a lambda is given as it stands
      : function_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
        call_([](void* of, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<Function>*>(of))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(function_, std::forward<Arguments>(arguments)...); }

 private:
  void* function_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace dsw
