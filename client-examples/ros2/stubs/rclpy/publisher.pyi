from typing import Generic, TypeVar

Message = TypeVar("Message", contravariant=True)

class Publisher(Generic[Message]):
    def publish(self, msg: Message) -> None: ...
