from typing import Callable, Generic, TypeVar

Result = TypeVar("Result")

class Future(Generic[Result]):
    def add_done_callback(self, callback: Callable[[Future[Result]], None]) -> None: ...
    def result(self) -> Result | None: ...
