from rclpy.node import Service

class Trigger(Service[Trigger.Request, Trigger.Response]):
    class Request: ...

    class Response:
        success: bool
        message: str
