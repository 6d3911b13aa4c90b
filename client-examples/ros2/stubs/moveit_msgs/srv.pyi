from moveit_msgs.msg import PlanningScene, PlanningSceneComponents
from rclpy.node import Service

class GetPlanningScene(Service[GetPlanningScene.Request, GetPlanningScene.Response]):
    class Request:
        def __init__(self, *, components: PlanningSceneComponents) -> None: ...

    class Response:
        scene: PlanningScene
