//! The planning calls: plan, verify, survey, knowledge.

use super::problem::{late, unread};
use super::{Computation, Form, KnownRequest, Served, Tools, json};
use crate::render;
use crate::wire::{
    AnswerBody, KnowledgeBody, PlanRequest, Problem, RequestLimits, SurveyBody, VerificationBody, VerifyRequest,
    read_scene, read_verify,
};
use singulate_planner::budget::{Budget, Interrupted};
use singulate_planner::knowledge::{NoBase, known};
use singulate_planner::paper::{GraspModelName, Judged, histograms};
use singulate_planner::plan::{Answer, Statistics, nothing_in_time};
use singulate_planner::search::SILENT;

/// Plans for the scene's target.
#[derive(Debug, Clone, Copy)]
pub struct Plan(
    /// The form of the answer.
    pub Form,
);

impl Plan {
    fn write(self, request: &PlanRequest, judged: &Judged) -> Served {
        match self.0 {
            Form::Json => json(&AnswerBody::new(request, judged)),
            Form::Svg => Ok(render::svg(&request.scene, judged).into_bytes()),
        }
    }
}

impl Computation for Plan {
    type Request = PlanRequest;

    fn read(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
        read_scene(body, limits)
    }

    fn compute(self, tools: &Tools, request: &PlanRequest, budget: &Budget<'_>) -> Served {
        let judged = tools.answer(request, budget, SILENT)?;
        self.write(request, &judged)
    }

    /// A time-out is a verdict, and has a drawing if the scene is known.
    fn too_late(self, known: KnownRequest<'_, PlanRequest>) -> Served {
        match (known, self.0) {
            (KnownRequest::Request(request), _) => {
                let answer = Answer { statement: nothing_in_time(&request.scene), statistics: Statistics::default() };
                self.write(request, &answer.into())
            }
            (KnownRequest::Glance(glance), Form::Json) => {
                AnswerBody::unread(glance).map_or_else(|| Err(unread()), |body| json(&body))
            }
            (KnownRequest::Glance(_), Form::Svg) => Err(unread()),
        }
    }
}

/// Checks a stated answer.
#[derive(Debug, Clone, Copy)]
pub struct Verification;

impl Computation for Verification {
    type Request = VerifyRequest;

    fn read(body: &[u8], limits: &RequestLimits) -> Result<VerifyRequest, Problem> {
        read_verify(body, limits)
    }

    fn compute(self, tools: &Tools, stated: &VerifyRequest, budget: &Budget<'_>) -> Served {
        let VerifyRequest { request, statement, terms } = stated;
        json(&VerificationBody::new(&(tools.engine.check)(&request.scene, statement, terms, budget)))
    }

    fn too_late(self, _: KnownRequest<'_, VerifyRequest>) -> Served {
        json(&VerificationBody::timed_out())
    }
}

/// The relocations that each movable object would need as the target.
#[derive(Debug, Clone, Copy)]
pub struct Survey;

impl Computation for Survey {
    type Request = PlanRequest;

    fn read(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
        read_scene(body, limits)
    }

    fn compute(self, tools: &Tools, request: &PlanRequest, budget: &Budget<'_>) -> Served {
        json(&SurveyBody::new(&request.scene, &tools.engine.survey(request, budget)?))
    }

    fn too_late(self, known: KnownRequest<'_, PlanRequest>) -> Served {
        match known {
            KnownRequest::Request(request) => json(&SurveyBody::timed_out(&request.scene)),
            KnownRequest::Glance(_) => Err(unread()),
        }
    }
}

/// The knowledge of each object before any search.
#[derive(Debug, Clone, Copy)]
pub struct Knowledge;

impl Computation for Knowledge {
    type Request = PlanRequest;

    fn read(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
        read_scene(body, limits)
    }

    fn compute(self, _: &Tools, request: &PlanRequest, budget: &Budget<'_>) -> Served {
        let model = request.methods.grasp_model;
        let known = known(&request.scene, model.model(), budget);
        let known = known.map_err(|error| match error {
            NoBase::Interrupted => late(),
            NoBase::TooLarge => Problem::too_dense(error.to_string()),
        })?;
        let histograms = match model {
            GraspModelName::SweptFinger => Vec::new(),
            GraspModelName::Sector => histograms(&request.scene, budget).map_err(|Interrupted| late())?,
        };
        json(&KnowledgeBody::new(&request.scene, &known, &histograms))
    }

    fn too_late(self, known: KnownRequest<'_, PlanRequest>) -> Served {
        match known {
            KnownRequest::Request(_) => Err(late()),
            KnownRequest::Glance(_) => Err(unread()),
        }
    }
}
