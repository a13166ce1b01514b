#pragma once

/// Tables of functions that are found by name at run time. A list of them is a macro,
///   #define LIST(X) X(gl, DrawArrays) X(gl, Enable)
/// of which a struct makes its members and, with a function find("glDrawArrays", member) at hand,
/// their values:
///   struct Functions {
///     explicit Functions(...) { LIST(RANGEZIP_FIND_FUNCTION) }
///     LIST(RANGEZIP_FUNCTION_MEMBER)
///   };
/// The functions' declarations must be included: they give the types.
// NOLINTNEXTLINE(bugprone-macro-parentheses): a declaration
#define RANGEZIP_FUNCTION_MEMBER(prefix, name) decltype(&::prefix##name) name = nullptr;
#define RANGEZIP_FIND_FUNCTION(prefix, name) find(#prefix #name, name);
