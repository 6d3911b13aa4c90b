"""The wiring: what is seen and what MoveIt knows go in, poses come out, whenever ~/plan is called."""

from contextlib import suppress
from dataclasses import asdict
from threading import Event

import rclpy
from geometry_msgs.msg import Pose, PoseArray
from moveit_msgs.msg import PlanningScene, PlanningSceneComponents
from moveit_msgs.srv import GetPlanningScene
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from vision_msgs.msg import Detection3DArray

from singulate_ros.failure import Failure
from singulate_ros.planning import plan
from singulate_ros.settings import Settings


class PlanNode(Node):
    def __init__(self) -> None:
        super().__init__("singulate")
        group = ReentrantCallbackGroup()  # planning blocks a thread; the others go on
        self.declare_parameters("", list(asdict(Settings()).items()))
        self._seen = Detection3DArray()
        self.create_subscription(Detection3DArray, "detections", self._see, 1, callback_group=group)
        self._moveit = self.create_client(GetPlanningScene, "get_planning_scene", callback_group=group)
        self._poses = self.create_publisher(PoseArray, "~/poses", 1)
        self.create_service(Trigger, "~/plan", self._plan, callback_group=group)

    def _see(self, detections: Detection3DArray) -> None:
        self._seen = detections

    def _plan(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        settings = Settings(**{name: self.get_parameter(name).value for name in asdict(Settings())})
        try:
            seen, clock, log = self._seen, self.get_clock(), self.get_logger()
            poses, words = plan(seen, self._planning_scene(), settings, lambda: clock.now().to_msg(), Pose, log.warning)
            self._poses.publish(PoseArray(header=seen.header, poses=poses))
            response.success, response.message = True, words
        except Failure as failure:
            self.get_logger().error(str(failure))
            response.success, response.message = False, str(failure)
        return response

    def _planning_scene(self) -> PlanningScene:
        wanted = PlanningSceneComponents(components=PlanningSceneComponents.WORLD_OBJECT_GEOMETRY)
        future, done = self._moveit.call_async(GetPlanningScene.Request(components=wanted)), Event()
        future.add_done_callback(lambda _: done.set())
        if not done.wait(5.0) or (known := future.result()) is None:
            raise Failure("MoveIt does not say what its planning scene is")
        return known.scene


def main() -> None:
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(PlanNode(), MultiThreadedExecutor(num_threads=4))
