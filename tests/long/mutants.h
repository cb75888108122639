#pragma once

// tests/long/mutants.py builds all mutants at once: it puts these switches in place of the tokens. The environment's
// ROAM_MUTANT is the number of the mutant that acts. `a < b` becomes `a < roam_mutant::Less{7} < b`, which has the same
// precedence. Constant expressions stay as they are.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>
#include <utility>

namespace roam_mutant {

enum Seen : unsigned char { never_computed, same, different, other_does_not_compile };

inline int active = 0;
/// Null, or what the process has seen of each mutant: whether it would have changed a value.
inline unsigned char* seen = nullptr;

inline bool start() {
  if (const char* const number = std::getenv("ROAM_MUTANT")) active = std::atoi(number);
  if (const char* const file = std::getenv("ROAM_MUTANTS_SEEN")) {
    const int descriptor = open(file, O_RDWR);
    const auto bytes = static_cast<std::size_t>(lseek(descriptor, 0, SEEK_END));  // one for each mutant
    void* const map = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (map == MAP_FAILED) std::abort();
    seen = static_cast<unsigned char*>(map);
  }
  return true;
}
inline const bool started = start();

inline void see(int mutant, Seen what) {
  if (seen != nullptr && seen[mutant] < what) seen[mutant] = what;
}

/// Whether the mutant acts. It always changes the value of its token.
inline bool acts(int mutant) {
  see(mutant, different);
  return active == mutant;
}

/// original() or other(), which have the same type.
template <class Original, class Other>
constexpr auto either(int mutant, Original original, Other other) {
  using Result = std::decay_t<decltype(original())>;
  if (std::is_constant_evaluated()) return Result(original());
  if (active == mutant) return Result(other());
  if (seen != nullptr) {
    if constexpr (std::is_arithmetic_v<Result>) {
      const Result value = original();
      // The other value of integers is not computed: a division by zero would end the process.
      constexpr bool can_trap = std::is_integral_v<Result> && !std::is_same_v<Result, bool>;
      see(mutant, !can_trap && value == other() ? same : different);
      return value;
    } else {
      see(mutant, different);
    }
  }
  return Result(original());
}

template <class T>
constexpr T number(int mutant, T original, T other) {
  if (std::is_constant_evaluated()) return original;
  return acts(mutant) ? other : original;
}

/// Not vectors of SIMD instructions: their operators are compiled for other processors than these functions.
template <class T>
concept Switched = alignof(std::remove_reference_t<T>) < 16;

/// An operand and what follows it.
template <class T>
struct Half {
  T&& operand;
  int mutant;
};

// OPERATOR as it is, and what is in its place.
#define ROAM_MUTANT_BINARY(NAME, OPERATOR, OTHER)                                                              \
  struct NAME {                                                                                                \
    int mutant;                                                                                                \
  };                                                                                                           \
  template <class T>                                                                                           \
  struct NAME##Half : Half<T> {};                                                                              \
  template <Switched L>                                                                                        \
  constexpr NAME##Half<L> operator OPERATOR(L&& left, NAME token) {                                            \
    return {{std::forward<L>(left), token.mutant}};                                                            \
  }                                                                                                            \
  template <class L, class R>                                                                                  \
  constexpr auto operator OPERATOR(NAME##Half<L> left, R&& right) {                                            \
    const auto original = [&] { return std::forward<L>(left.operand) OPERATOR std::forward<R>(right); };       \
    if constexpr (requires { std::forward<L>(left.operand) OTHER std::forward<R>(right); }) {                  \
      const auto other = [&] { return std::forward<L>(left.operand) OTHER std::forward<R>(right); };           \
      if constexpr (std::is_same_v<decltype(original()), decltype(other())>)                                   \
        return either(left.mutant, original, other);                                                           \
    }                                                                                                          \
    if (!std::is_constant_evaluated()) see(left.mutant, other_does_not_compile);                               \
    return original();                                                                                         \
  }
ROAM_MUTANT_BINARY(Less, <, <=)
ROAM_MUTANT_BINARY(LessEqual, <=, <)
ROAM_MUTANT_BINARY(Greater, >, >=)
ROAM_MUTANT_BINARY(GreaterEqual, >=, >)
ROAM_MUTANT_BINARY(Equal, ==, !=)
ROAM_MUTANT_BINARY(Unequal, !=, ==)
ROAM_MUTANT_BINARY(Plus, +, -)
ROAM_MUTANT_BINARY(Minus, -, +)
ROAM_MUTANT_BINARY(Times, *, /)
ROAM_MUTANT_BINARY(Over, /, *)

// The same for assignments, which group from the right: `x += roam_mutant::Add{7} += y`.
#define ROAM_MUTANT_ASSIGNMENT(NAME, OPERATOR, OTHER)                                  \
  struct NAME {                                                                        \
    int mutant;                                                                        \
  };                                                                                   \
  template <class T>                                                                   \
  struct NAME##Half : Half<T> {};                                                      \
  template <class R>                                                                   \
  constexpr NAME##Half<R> operator OPERATOR(NAME token, R&& right) {                   \
    return {{std::forward<R>(right), token.mutant}};                                   \
  }                                                                                    \
  template <class L, class R>                                                          \
  constexpr L& operator OPERATOR(L& left, NAME##Half<R> right) {                       \
    if constexpr (requires { left OTHER std::forward<R>(right.operand); }) {           \
      if (!std::is_constant_evaluated() && acts(right.mutant)) {                       \
        left OTHER std::forward<R>(right.operand);                                     \
        return left;                                                                   \
      }                                                                                \
    } else {                                                                           \
      if (!std::is_constant_evaluated()) see(right.mutant, other_does_not_compile);    \
    }                                                                                  \
    left OPERATOR std::forward<R>(right.operand);                                      \
    return left;                                                                       \
  }
ROAM_MUTANT_ASSIGNMENT(Add, +=, -=)
ROAM_MUTANT_ASSIGNMENT(Subtract, -=, +=)

/// `-a` becomes `roam_mutant::Negative{7}->*a`, which binds more tightly than a product.
struct Negative {
  int mutant;
};
template <class T>
constexpr auto operator->*(Negative token, T&& operand) {
  using Result = std::decay_t<decltype(-operand)>;
  if constexpr (std::is_same_v<std::decay_t<T>, Result>)
    return either(token.mutant, [&] { return Result(-operand); }, [&] { return Result(operand); });
  if (!std::is_constant_evaluated()) see(token.mutant, other_does_not_compile);
  return Result(-operand);
}

/// `a && b` becomes `a && roam_mutant::always(7) && b`, which the mutant makes false.
constexpr bool always(int mutant) { return std::is_constant_evaluated() || !acts(mutant); }
/// `a || b` becomes `a || roam_mutant::never(7) || b`, which the mutant makes true.
constexpr bool never(int mutant) { return !std::is_constant_evaluated() && acts(mutant); }

}  // namespace roam_mutant
