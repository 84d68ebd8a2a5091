/// Objects whose class one source file knows alone: their owners need no destructor and no move of their own.
#pragma once

#include <memory>
#include <utility>

namespace touchmark::baselines {

template <class T>
struct DeleteHidden {
  void (*destroy)(T*) = nullptr;
  void operator()(T* hidden) const noexcept { destroy(hidden); }
};

/// Owns a T, which may be incomplete, or nothing.
template <class T>
using Hidden = std::unique_ptr<T, DeleteHidden<T>>;

/// Makes a T, or a class derived of it.
template <class T, class Made = T, class... Arguments>
Hidden<T> make_hidden(Arguments&&... arguments) {
  return Hidden<T>(new Made(std::forward<Arguments>(arguments)...),
                   {[](T* hidden) { delete static_cast<Made*>(hidden); }});
}

}  // namespace touchmark::baselines
