#include "failures.h"

namespace wrapatlas::python {
namespace {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::input:
      return "input";
    case ErrorKind::output:
      return "output";
    case ErrorKind::no_packing:
      return "no_packing";
    case ErrorKind::check:
      return "check";
    case ErrorKind::interrupted:
      return "interrupted";
  }
  return "input";
}

}  // namespace

void raise(const Error& error) {
  const std::string line = error.message();
  // File names need not be valid UTF-8.
  const nb::object text = nb::steal(
      PyUnicode_DecodeUTF8(line.data(), static_cast<Py_ssize_t>(line.size()), "backslashreplace"));
  const nb::object exception =
      nb::module_::import_("wrapatlas._errors").attr("make")(name_of(error.kind), text);
  PyErr_SetObject(exception.type().ptr(), exception.ptr());
  throw nb::python_error();
}

}  // namespace wrapatlas::python
