from typing import Generic, TypeVar

from rclpy.task import Future

Request = TypeVar("Request")
Response = TypeVar("Response")

class Client(Generic[Request, Response]):
    def call_async(self, request: Request) -> Future[Response]: ...
