from typing import Any, Callable, Generic, TypeVar

from rclpy.callback_groups import CallbackGroup
from rclpy.client import Client
from rclpy.clock import Clock
from rclpy.logging import Logger
from rclpy.publisher import Publisher

Message = TypeVar("Message")
Request = TypeVar("Request")
Response = TypeVar("Response")

# Stands for what all types of services have in common; in ROS that has no name.
class Service(Generic[Request, Response]): ...

class Parameter:
    value: Any

class Node:
    def __init__(self, node_name: str) -> None: ...
    def declare_parameters(self, namespace: str, parameters: list[tuple[str, Any]]) -> list[Parameter]: ...
    def get_parameter(self, name: str) -> Parameter: ...
    def get_clock(self) -> Clock: ...
    def get_logger(self) -> Logger: ...
    def create_publisher(self, msg_type: type[Message], topic: str, qos_profile: int) -> Publisher[Message]: ...
    def create_subscription(
        self,
        msg_type: type[Message],
        topic: str,
        callback: Callable[[Message], None],
        qos_profile: int,
        *,
        callback_group: CallbackGroup,
    ) -> object: ...
    def create_client(
        self, srv_type: type[Service[Request, Response]], srv_name: str, *, callback_group: CallbackGroup
    ) -> Client[Request, Response]: ...
    def create_service(
        self,
        srv_type: type[Service[Request, Response]],
        srv_name: str,
        callback: Callable[[Request, Response], Response],
        *,
        callback_group: CallbackGroup,
    ) -> object: ...
