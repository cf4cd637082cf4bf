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
  // File names need not be valid UTF-8.
  const auto text = [](const std::string& line) {
    return nb::steal(PyUnicode_DecodeUTF8(line.data(), static_cast<Py_ssize_t>(line.size()),
                                          "backslashreplace"));
  };
  const nb::object exception =
      nb::module_::import_("wrapatlas._errors")
          .attr("make")(name_of(error.kind), text(error.message()), text(error.where));
  PyErr_SetObject(exception.type().ptr(), exception.ptr());
  throw nb::python_error();
}

}  // namespace wrapatlas::python
