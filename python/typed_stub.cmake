# Stubs as nanobind writes them, with a type for the entries of arrays that may be of any.
file(READ ${IN} text)
string(REPLACE "Annotated[NDArray," "Annotated[NDArray[Any]," text "${text}")
string(REPLACE "from typing import Annotated" "from typing import Annotated, Any" text "${text}")
file(WRITE ${OUT} "${text}")
