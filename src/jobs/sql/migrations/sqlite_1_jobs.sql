-- Everything of a job is in its row, so that each change is one row. What is long stands last: short reads don't pass it.
-- A scene's name and a callback's address are bytes: as JSON strings they may hold U+0000.
CREATE TABLE jobs (
    id TEXT PRIMARY KEY NOT NULL,
    owner TEXT NOT NULL,
    idempotency_key TEXT,
    key_position BIGINT NOT NULL,
    request_sha256 TEXT NOT NULL,
    state TEXT NOT NULL,
    priority BIGINT NOT NULL,
    turn BIGINT NOT NULL,
    attempts BIGINT NOT NULL,
    fence BIGINT NOT NULL,
    lease_ends BIGINT,
    cancel_requested BIGINT NOT NULL,
    ended_by BIGINT,
    created_at BIGINT NOT NULL,
    started_at BIGINT,
    finished_at BIGINT,
    expires_at BIGINT NOT NULL,
    cost BIGINT,
    lower_bound BIGINT,
    version TEXT,
    callback_url BLOB,
    callback_due BIGINT,
    callback_attempt BIGINT NOT NULL,
    scene_sha256 TEXT NOT NULL,
    scene_id BLOB,
    events TEXT NOT NULL,
    problem TEXT,
    result TEXT,
    body BLOB
);

CREATE UNIQUE INDEX jobs_by_key ON jobs (owner, idempotency_key, key_position) WHERE idempotency_key IS NOT NULL;
CREATE INDEX jobs_by_owner ON jobs (owner, id);
CREATE INDEX jobs_to_claim ON jobs (priority DESC, turn, id) WHERE state = 'queued';
CREATE INDEX jobs_by_turn ON jobs (owner, priority, turn) WHERE state = 'queued';
CREATE INDEX jobs_by_lease ON jobs (lease_ends) WHERE state = 'running';
CREATE INDEX jobs_by_expiry ON jobs (expires_at);
CREATE INDEX jobs_to_call_back ON jobs (callback_due) WHERE callback_due IS NOT NULL;
