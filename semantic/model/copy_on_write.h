// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

namespace oikos::semantic {

/// A value whose copies share memory until one of them is changed: a copy costs a pointer, a change a copy of the value. Copies may be
/// read and changed on different threads.
template <class T>
class CopyOnWrite {
 public:
  CopyOnWrite() : value_(std::make_shared<const T>()) {}
  CopyOnWrite(T value)
      : value_(std::make_shared<const T>(std::move(value))) {}  // NOLINT(google-explicit-constructor): it stands for the value

  /// For building it up: `value` may be changed through that pointer as long as nobody else reads it.
  explicit CopyOnWrite(std::shared_ptr<T> value) : value_(std::move(value)) {}

  operator const T&() const { return *value_; }  // NOLINT(google-explicit-constructor)
  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }

  /// A new copy of the value, to be changed before this object is copied. (That nobody shares the old one cannot be told without a race.)
  T& edit() {
    const auto copy = std::make_shared<T>(*value_);
    value_ = copy;
    return *copy;
  }

  bool operator==(const CopyOnWrite& other) const { return value_ == other.value_ || *value_ == *other.value_; }

 private:
  std::shared_ptr<const T> value_;
};

}  // namespace oikos::semantic
