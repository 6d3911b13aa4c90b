from builtin_interfaces.msg import Time as Stamp

class Time:
    def to_msg(self) -> Stamp: ...

class Clock:
    def now(self) -> Time: ...
